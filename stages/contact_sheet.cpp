// SPDX-License-Identifier: Apache-2.0
#include "stages/contact_sheet.h"

#include <algorithm>
#include <cstddef>

namespace vitrine {
namespace {

constexpr int kRows = 8;

std::uint8_t amplified_square(int a, int b) {
  return static_cast<std::uint8_t>(std::min(255, (8 * (a - b) * (a - b) + 127) / 255));
}

/// Copies a x a texels into the sheet, `texel(i, k)` being channel k of the i-th.
template <class Texel>
void place(Image& sheet, int left, int top, int size, Texel const& texel) {
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      for (int k = 0; k < 3; ++k)
        sheet.texels[3 * (std::size_t(top + y) * sheet.width + left + x) + k] = texel(std::size_t(y) * size + x, k);
}

}  // namespace

Image contact_sheet(std::vector<Image> const& originals, std::vector<Image> const& thumbnails) {
  int const views = int(originals.size()), size = originals[0].width;
  int const rows = std::min(views, kRows), columns = (views + kRows - 1) / kRows;
  Image sheet{3 * size * columns, size * rows, 3, ColourSpace::srgb, {}};
  sheet.texels.assign(std::size_t(3) * sheet.width * sheet.height, 255);
  for (int view = 0; view < views; ++view) {
    std::vector<std::uint8_t> const &a = originals[view].texels, &b = thumbnails[view].texels;
    int const left = 3 * size * (view / kRows), top = size * (view % kRows);
    place(sheet, left, top, size, [&](std::size_t i, int k) { return a[4 * i + k]; });
    place(sheet, left + size, top, size, [&](std::size_t i, int k) { return b[4 * i + k]; });
    place(sheet, left + 2 * size, top, size,
          [&](std::size_t i, int k) { return amplified_square(a[4 * i + k], b[4 * i + k]); });
  }
  return sheet;
}

}  // namespace vitrine
