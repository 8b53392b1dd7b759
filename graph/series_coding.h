// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How the frames of a series are coded; series_sizes and series_files share it, so that both speak of the same bytes.

#include "io/image_codec.h"
#include "stages/options.h"

#include <string>
#include <vector>

namespace vitrine {

enum class SeriesCodec { jpeg, webp, avif };
template <>
struct EnumNames<SeriesCodec> {
  static constexpr std::array<std::string_view, 3> names{"jpeg", "webp", "avif"};
};

namespace graph {

std::string name_of(SeriesCodec codec);

/// The paper's 90 for JPEG, 80 for WebP, and for AVIF 65, which is as far off as that WebP.
int usual_quality(SeriesCodec codec);

/// As image tools write it (io::Effort::usual); JPEG with full chroma.
io::ImageQuality coding(SeriesCodec codec, int quality);

/// RGB of RGBA: the alpha of a picture is the coverage of the object and no part of what is seen.
std::vector<Image> without_alpha(std::vector<Image> const& pictures);

struct CodedFrames {
  std::vector<std::vector<std::byte>> files;
  std::vector<Image> decoded;
};

/// In parallel; the same at any number of threads. In: RGB pictures.
CodedFrames code_frames(std::vector<Image> const& pictures, io::ImageQuality const& quality);

}  // namespace graph
}  // namespace vitrine
