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
  return {codec_asked_for(options.colour_codec).value_or(usual), options.colour_quality, options.full_chroma,
          options.draft ? Effort::thorough : Effort::utmost};
}

/// Of the logarithm of the bytes with the quality, as it was for atlases of scans.
double usual_rise(ImageQuality const& quality) {
  double const webp = 0.05 - 0.009 * std::log(std::max(quality.quality, 5));
  return quality.codec == ImageCodec::avif ? 2 * webp : webp;
}

/// What the search for a quality knows.
struct Point {
  int quality;
  double filled;  ///< logarithm of the share of the room
};

/// Where the line through the last two points, in the logarithm of the bytes, meets what is aimed at.
int next_quality(Point const& here, std::optional<Point> const& before, double usual, double aim) {
  constexpr double kLeastRise = 0.005, kMostRise = 0.1;  // of the logarithm
  double const rise = before ? (here.filled - before->filled) / (here.quality - before->quality) : usual;
  return here.quality + int(std::lround((std::log(aim) - here.filled) / std::clamp(rise, kLeastRise, kMostRise)));
}

CodedColour largest_within(std::size_t room, Image const& map, ImageQuality quality) {
  constexpr int kLowest = 5, kHighest = 95;
  if (quality.codec == ImageCodec::png) return {encode_image(map, quality), kHighest};
  double const near = quality.effort == Effort::utmost ? 0.975 : 0.94, aim = (near + 1) / 2;  // of the room
  std::optional<Point> before;
  CodedColour best;
  bool best_fits = false;
  for (int low = kLowest, high = kHighest;;) {
    quality.quality = std::clamp(quality.quality, low, high);
    CodedColour coded{encode_image(map, quality), quality.quality};
    Point const here{coded.quality,
                     std::log(double(coded.image.bytes.size()) / double(std::max<std::size_t>(room, 1)))};
    bool const fits = here.filled <= 0;
    int& bound = fits ? low : high;
    for (bound = here.quality; low <= high && is_same_coding(quality.codec, bound, here.quality);)
      bound += fits ? 1 : -1;
    if (fits || !best_fits) best = std::move(coded);
    best_fits |= fits;
    if (low > high || (fits && here.filled >= std::log(near))) return best;
    quality.quality = next_quality(here, before, usual_rise(quality), aim);
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
  CodedColour coded = largest_within(room, map, wanted(options));
  if (!codec_asked_for(options.colour_codec)) coded.image = nearer_coding(map, std::move(coded.image));
  return coded;
}

}  // namespace vitrine::io
