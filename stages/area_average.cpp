// SPDX-License-Identifier: Apache-2.0
#include "stages/area_average.h"

#include "stages/colour.h"

#include <algorithm>
#include <cmath>

namespace vitrine {
namespace {

bool has_alpha(Image const& image) { return image.channels % 2 == 0; }

/// A texel's channels as they are averaged: grey three times, then alpha.
void read_texel(Image const& image, std::size_t texel, std::array<float, 4>& values) {
  std::size_t const channels = std::size_t(image.channels);
  std::uint8_t const* const bytes = &image.texels[texel * channels];
  for (std::size_t k = 0; k < 3; ++k) {
    std::uint8_t const byte = bytes[channels < 3 ? 0 : k];
    values[k] = image.space == ColourSpace::srgb ? kLinearOfSrgb[byte] : float(byte) / 255;
  }
  values[3] = has_alpha(image) ? float(bytes[channels - 1]) / 255 : 1;
}

}  // namespace

std::vector<Overlap> overlaps(int length, int count) {
  double const scale = double(length) / count;
  std::vector<Overlap> all;
  for (int to = 0; to < count; ++to) {
    double const low = to * scale, high = (to + 1) * scale;
    for (int from = int(low), end = std::min(length, int(std::ceil(high))); from < end; ++from) {
      double const share = (std::min(high, from + 1.0) - std::max(low, double(from))) / scale;
      if (share > 0) all.push_back({std::size_t(to), std::size_t(from), float(share)});
    }
  }
  return all;
}

Image area_average(Image const& image, int width, int height) {
  std::vector<Overlap> const columns = overlaps(image.width, width);
  std::vector<std::array<float, 4>> sums(std::size_t(width) * std::size_t(height));
  for (Overlap const& row : overlaps(image.height, height))
    for (Overlap const& column : columns) {
      std::array<float, 4> values;
      read_texel(image, row.from * std::size_t(image.width) + column.from, values);
      std::array<float, 4>& sum = sums[row.to * std::size_t(width) + column.to];
      for (std::size_t k = 0; k < 4; ++k) sum[k] += row.share * column.share * values[k];
    }

  Image out{width, height, has_alpha(image) ? 4 : 3, image.space, {}};
  out.texels.reserve(sums.size() * std::size_t(out.channels));
  for (std::array<float, 4> const& sum : sums) {
    for (std::size_t k = 0; k < 3; ++k)
      out.texels.push_back(to_byte(image.space == ColourSpace::srgb ? linear_to_srgb(std::min(sum[k], 1.f)) : sum[k]));
    if (out.channels == 4) out.texels.push_back(to_byte(sum[3]));
  }
  return out;
}

}  // namespace vitrine
