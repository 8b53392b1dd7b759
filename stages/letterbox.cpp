// SPDX-License-Identifier: Apache-2.0
#include "stages/letterbox.h"

#include "stages/area_average.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace vitrine {
namespace {

/// Adds a row of the picture, laid on white, to three sums for each texel of a shorter row.
void add_row(Image const& picture, std::size_t y, std::vector<Overlap> const& columns, float share, float* sums) {
  std::size_t const step = std::size_t(picture.channels);
  std::uint8_t const* const row = &picture.texels[y * std::size_t(picture.width) * step];
  for (Overlap const& column : columns) {
    std::uint8_t const* const texel = row + column.from * step;
    float const opaque = step % 2 == 0 ? float(texel[step - 1]) / 255 : 1, weight = share * column.share;
    for (std::size_t k = 0; k < 3; ++k)
      sums[3 * column.to + k] += weight * (255 + opaque * (float(texel[step < 3 ? 0 : k]) - 255));
  }
}

}  // namespace

Image letterbox(Image const& picture, int size) {
  double const scale = std::min(1.0, double(size) / std::max(picture.width, picture.height));
  auto const side = [&](int length) { return std::clamp(int(std::lround(length * scale)), 1, size); };
  int const width = side(picture.width), height = side(picture.height);
  std::vector<Overlap> const columns = overlaps(picture.width, width);
  std::vector<float> sums(3 * std::size_t(width) * std::size_t(height));
  for (Overlap const& row : overlaps(picture.height, height))
    add_row(picture, row.from, columns, row.share, &sums[3 * std::size_t(width) * row.to]);

  Image square{size, size, 3, ColourSpace::srgb, {}};
  square.texels.assign(3 * std::size_t(size) * std::size_t(size), 255);
  std::size_t const left = std::size_t(size - width) / 2, top = std::size_t(size - height) / 2;
  for (std::size_t y = 0; y < std::size_t(height); ++y)
    std::transform(&sums[3 * y * std::size_t(width)], &sums[3 * y * std::size_t(width)] + 3 * width,
                   &square.texels[3 * ((top + y) * std::size_t(size) + left)],
                   [](float value) { return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.f, 255.f))); });
  return square;
}

}  // namespace vitrine
