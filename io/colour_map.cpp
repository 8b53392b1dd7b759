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

/// Of the logarithm of the bytes with the quality, as it was for atlases of scans.
double usual_rise(ImageQuality const& quality) {
  double const webp = 0.05 - 0.009 * std::log(std::max(quality.quality, 5));
  return quality.codec == ImageCodec::avif ? 2 * webp : webp;
}

/// The next quality is where the line through the last two, in the logarithm of the bytes, meets the room.
CodedColour largest_within(std::size_t room, Image const& map, EncodeOptions options) {
  constexpr int kLowest = 5, kHighest = 95;
  constexpr double kAim = 0.9875, kNear = 0.975;         // of the room
  constexpr double kLeastRise = 0.005, kMostRise = 0.1;  // of the logarithm
  struct Point {
    int quality;
    double filled;  ///< logarithm of the share of the room
  };
  std::optional<Point> before;
  std::optional<CodedColour> best;
  for (int low = kLowest, high = kHighest;;) {
    options.colour_quality = std::clamp(options.colour_quality, low, high);
    CodedColour coded{encode_image(map, wanted(options)), options.colour_quality};
    Point const here{coded.quality,
                     std::log(double(coded.image.bytes.size()) / double(std::max<std::size_t>(room, 1)))};
    bool const fits = here.filled <= 0;
    (fits ? low : high) = here.quality + (fits ? 1 : -1);
    if (fits || here.quality == kLowest) best = std::move(coded);
    if (low > high || (fits && here.filled >= std::log(kNear))) return *std::move(best);
    double const rise =
        before ? (here.filled - before->filled) / (here.quality - before->quality) : usual_rise(wanted(options));
    options.colour_quality +=
        int(std::lround((std::log(kAim) - here.filled) / std::clamp(rise, kLeastRise, kMostRise)));
    before = here;
  }
}

}  // namespace

CodedColour code_colour(Image const& map, EncodeOptions const& options) {
  EncodedImage coded = encode_image(map, wanted(options));
  if (!codec_asked_for(options.colour_codec)) coded = nearer_coding(map, std::move(coded));
  return {std::move(coded), options.colour_quality};
}

CodedColour code_colour_within(std::size_t room, Image const& map, EncodeOptions const& options) {
  CodedColour coded = largest_within(room, map, options);
  if (!codec_asked_for(options.colour_codec)) coded.image = nearer_coding(map, std::move(coded.image));
  return coded;
}

}  // namespace vitrine::io
