// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Sets of texels as rows of bits: where a chart lies, and where there is room for it.

#include "stages/data.h"

#include <optional>
#include <span>

namespace vitrine {

using Imath::V2d;
using Imath::V2i;

class TexelMask {
 public:
  TexelMask(int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }
  bool at(int x, int y) const { return row(y)[std::size_t(x) / 64] >> (x % 64) & 1; }
  std::size_t count() const;

  /// Adds each texel whose square the triangle touches, or comes nearer to than kSafety. Corners in texels, inside the
  /// mask.
  void cover(std::array<V2d, 3> const& triangle);

  /// Adds the shape, moved by `at`, and all texels within `margin` of it (both ways at once); cut at this mask's
  /// border.
  void add(TexelMask const& shape, V2i at, int margin);

  /// The lowest row, then column, at which the shape, moved there, shares no texel with this mask.
  std::optional<V2i> room_for(TexelMask const& shape) const;

  /// Rounding of texture coordinates to float moves corners by less than this (half a step of a float at 8192 texels:
  /// 1/4096).
  static constexpr double kSafety = 1.0 / 512;

 private:
  using Word = std::uint64_t;
  std::span<Word> row(int y) { return std::span(bits_).subspan(std::size_t(y) * words_, words_); }
  std::span<Word const> row(int y) const { return std::span(bits_).subspan(std::size_t(y) * words_, words_); }
  int longest_run(int y, bool of_set) const;
  int columns_to_skip(TexelMask const& shape, int shape_row, V2i at) const;

  int width_, height_;
  std::size_t words_;  ///< a row's
  std::vector<Word> bits_;
  std::vector<int> free_runs_;  ///< a row's longest run of texels that are not in the mask, as of the last add()
};

}  // namespace vitrine
