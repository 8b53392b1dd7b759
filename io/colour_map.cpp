// SPDX-License-Identifier: Apache-2.0
#include "io/colour_map.h"

#include "io/map_codec.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vitrine::io {

std::optional<ImageCodec> codec_asked_for(MapCodec codec) {
  switch (codec) {
    case MapCodec::webp:
      return ImageCodec::webp;
    case MapCodec::avif:
      return ImageCodec::avif;
    case MapCodec::jpeg:
      return ImageCodec::jpeg;
    case MapCodec::png:
      return ImageCodec::png;
    default:
      return std::nullopt;
  }
}

namespace {

ImageQuality wanted(EncodeOptions const& options) {
  ImageCodec const usual = common_maps(options.profile) ? ImageCodec::jpeg : ImageCodec::webp;
  return {codec_asked_for(options.colour_codec).value_or(usual), options.colour_quality};
}

/// What code_colour() gives, or a little more.
CodedColour try_colour(Image const& map, EncodeOptions const& options) {
  return {encode_image(map, wanted(options)), options.colour_quality};
}

/// The logarithm of the bytes rises with the quality about as a line does.
CodedColour largest_within(std::size_t room, Image const& map, EncodeOptions options) {
  constexpr int kLowest = 5, kHighest = 95;
  constexpr double kRise = 0.025, kNear = 0.975;
  std::optional<CodedColour> best;
  for (int low = kLowest, high = kHighest;;) {
    options.colour_quality = std::clamp(options.colour_quality, low, high);
    CodedColour coded = try_colour(map, options);
    double const filled = double(coded.image.bytes.size()) / double(std::max<std::size_t>(room, 1));
    bool const fits = filled <= 1;
    (fits ? low : high) = coded.quality + (fits ? 1 : -1);
    options.colour_quality += int(std::lround(-std::log(filled / kNear) / kRise));
    if (fits || coded.quality == kLowest) best = std::move(coded);
    if (low > high || (fits && filled >= kNear)) return *std::move(best);
  }
}

}  // namespace

CodedColour code_colour(Image const& map, EncodeOptions const& options) {
  bool const asked = codec_asked_for(options.colour_codec).has_value();
  return {asked ? encode_image(map, wanted(options)) : encode_map(map, wanted(options)), options.colour_quality};
}

CodedColour code_colour_within(std::size_t room, Image const& map, EncodeOptions const& options) {
  CodedColour coded = largest_within(room, map, options);
  if (codec_asked_for(options.colour_codec)) return coded;
  EncodeOptions found = options;
  found.colour_quality = coded.quality;
  return code_colour(map, found);
}

}  // namespace vitrine::io
