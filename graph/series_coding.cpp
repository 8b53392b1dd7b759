// SPDX-License-Identifier: Apache-2.0
#include "graph/series_coding.h"

#include "stages/parallel.h"

#include <utility>

namespace vitrine::graph {
namespace {

struct Coding {
  io::ImageCodec codec;
  int quality;
  bool full_chroma;
};
constexpr Coding kCodings[] = {
    {io::ImageCodec::jpeg, 90, true}, {io::ImageCodec::webp, 80, false}, {io::ImageCodec::avif, 65, false}};

Coding const& coding_of(SeriesCodec codec) { return kCodings[static_cast<std::size_t>(codec)]; }

}  // namespace

std::string name_of(SeriesCodec codec) {
  return std::string(EnumNames<SeriesCodec>::names[static_cast<std::size_t>(codec)]);
}

int usual_quality(SeriesCodec codec) { return coding_of(codec).quality; }

io::ImageQuality coding(SeriesCodec codec, int quality) {
  Coding const& found = coding_of(codec);
  return {found.codec, quality, found.full_chroma, io::Effort::usual};
}

std::vector<Image> without_alpha(std::vector<Image> const& pictures) {
  std::vector<Image> all(pictures.size());
  parallel_for(pictures.size(), 1, [&](std::size_t i) { all[i] = opaque(pictures[i]); });
  return all;
}

CodedFrames code_frames(std::vector<Image> const& pictures, io::ImageQuality const& quality) {
  CodedFrames coded{std::vector<std::vector<std::byte>>(pictures.size()), std::vector<Image>(pictures.size())};
  parallel_for(pictures.size(), 1, [&](std::size_t i) {
    coded.files[i] = io::encode_image(pictures[i], quality).bytes;
    coded.decoded[i] = io::decode_image(coded.files[i], ColourSpace::srgb);
  });
  return coded;
}

}  // namespace vitrine::graph
