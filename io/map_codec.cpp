// SPDX-License-Identifier: Apache-2.0
#include "io/map_codec.h"

#include <cstddef>
#include <optional>
#include <utility>

namespace vitrine::io {
namespace {

/// Sum of squares over the texels, of three channels.
double error(Image const& map, EncodedImage const& coded) {
  Image const decoded = decode_image(coded.bytes, map.space);
  double sum = 0;
  for (std::size_t i = 0; i < map.texels.size(); ++i) {
    double const d = double(map.texels[i]) - double(decoded.texels[i]);
    sum += d * d;
  }
  return sum;
}

/// What a coding with halved chroma leaves, were it perfect otherwise.
double halved_chroma_error(Image const& map) { return error(map, encode_image(map, {ImageCodec::jpeg, 100, false})); }

/// The best JPEG with full chroma that `budget` bytes hold.
std::optional<EncodedImage> full_chroma_within(std::size_t budget, Image const& map) {
  std::optional<EncodedImage> best;
  for (int low = 1, high = 100; low <= high;) {
    int const quality = (low + high) / 2;
    EncodedImage coded = encode_image(map, {ImageCodec::jpeg, quality, true});
    bool const fits = coded.bytes.size() <= budget;
    if (fits) best = std::move(coded);
    (fits ? low : high) = fits ? quality + 1 : quality - 1;
  }
  return best;
}

}  // namespace

EncodedImage encode_map(Image const& map, ImageQuality const& quality) {
  return nearer_coding(map, encode_image(map, quality));
}

EncodedImage nearer_coding(Image const& map, EncodedImage coded) {
  if (map.channels != 3 || (coded.mime != "image/webp" && coded.mime != "image/jpeg")) return coded;
  double const reached = error(map, coded);
  if (halved_chroma_error(map) < reached / 3) return coded;
  std::optional<EncodedImage> rival = full_chroma_within(coded.bytes.size(), map);
  return rival && error(map, *rival) < reached ? *std::move(rival) : coded;
}

}  // namespace vitrine::io
