// SPDX-License-Identifier: Apache-2.0
#include "stages/texel_mask.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

namespace vitrine {
namespace {

using Word = std::uint64_t;

/// Word `w` of a row moved right by `shift` columns; what lies outside the row is 0.
Word moved_word(std::span<Word const> row, std::size_t w, int shift) {
  std::ptrdiff_t const start = std::ptrdiff_t(w) * 64 - shift;  // the bit that arrives in the word's lowest place
  std::ptrdiff_t const i = start >> 6;
  int const part = int(start & 63);
  auto const at = [&](std::ptrdiff_t k) {
    return k >= 0 && k < std::ptrdiff_t(row.size()) ? row[std::size_t(k)] : Word{0};
  };
  return part == 0 ? at(i) : at(i) >> part | at(i + 1) << (64 - part);
}

/// Number of set bits in a row from `column` to the left, without a gap.
int run_ending_at(std::span<Word const> row, int column) {
  int run = 0;
  for (int k = column / 64, bit = column % 64; k >= 0; --k, bit = 63) {
    int const ones = std::countl_one(row[std::size_t(k)] << (63 - bit));
    run += ones;
    if (ones <= bit) break;
  }
  return run;
}

/// The part of an edge between two heights, as its range of x; false if the edge does not reach between them.
bool reach_between(V2d p, V2d q, double low, double high, double& left, double& right) {
  if (p.y > q.y) std::swap(p, q);
  if (q.y < low || p.y > high) return false;
  auto const x_at = [&](double y) { return p.x + (q.x - p.x) * ((y - p.y) / (q.y - p.y)); };
  double const from = p.y < low ? x_at(low) : p.x, to = q.y > high ? x_at(high) : q.x;
  left = std::min({left, from, to});
  right = std::max({right, from, to});
  return true;
}

}  // namespace

TexelMask::TexelMask(int width, int height)
    : width_(width),
      height_(height),
      words_((std::size_t(width) + 63) / 64),
      bits_(words_ * std::size_t(height)),
      free_runs_(std::size_t(height), width) {}

std::size_t TexelMask::count() const {
  return std::accumulate(bits_.begin(), bits_.end(), std::size_t{0},
                         [](std::size_t n, Word w) { return n + std::size_t(std::popcount(w)); });
}

void TexelMask::cover(std::array<V2d, 3> const& triangle) {
  auto const [bottom, top] = std::minmax({triangle[0].y, triangle[1].y, triangle[2].y});
  int const first = std::max(0, int(std::floor(bottom - kSafety)));
  int const last = std::min(height_ - 1, int(std::floor(top + kSafety)));
  for (int y = first; y <= last; ++y) {
    double left = std::numeric_limits<double>::infinity(), right = -left;
    bool reached = false;
    for (std::size_t i = 0; i < 3; ++i)
      reached |= reach_between(triangle[i], triangle[(i + 1) % 3], y - kSafety, y + 1 + kSafety, left, right);
    if (!reached) continue;
    int const from = std::max(0, int(std::floor(left - kSafety)));
    int const to = std::min(width_ - 1, int(std::floor(right + kSafety)));
    std::span<Word> const bits = row(y);
    for (int x = from; x <= to; x = (x / 64 + 1) * 64) {
      int const end = std::min(to, x / 64 * 64 + 63);
      bits[std::size_t(x) / 64] |= ~Word{0} >> (63 - (end - x)) << (x % 64);
    }
  }
}

void TexelMask::add(TexelMask const& shape, V2i at, int margin) {
  Word const last_word = ~Word{0} >> (words_ * 64 - std::size_t(width_));
  std::vector<Word> wide(std::size_t(shape.width_ + 2 * margin) / 64 + 1);  // a row of the shape, grown sideways
  for (int y = 0; y < shape.height_; ++y) {
    std::ranges::fill(wide, Word{0});
    for (int shift = 0; shift <= 2 * margin; ++shift)
      for (std::size_t w = 0; w < wide.size(); ++w) wide[w] |= moved_word(shape.row(y), w, shift);
    int const first = std::max(0, at.y + y - margin), last = std::min(height_ - 1, at.y + y + margin);
    for (int target = first; target <= last; ++target) {
      for (std::size_t w = 0; w < words_; ++w) row(target)[w] |= moved_word(wide, w, at.x - margin);
      row(target)[words_ - 1] &= last_word;
    }
  }
  for (int y = std::max(0, at.y - margin); y < std::min(height_, at.y + shape.height_ + margin); ++y)
    free_runs_[std::size_t(y)] = longest_run(y, false);
}

std::optional<V2i> TexelMask::room_for(TexelMask const& shape) const {
  std::vector<int> runs;
  for (int y = 0; y < shape.height_; ++y) runs.push_back(shape.longest_run(y, true));
  int clashing_row = 0;  // the one that clashed last is the likeliest to clash again
  for (int y = 0; y + shape.height_ <= height_; ++y) {
    if (!std::equal(runs.begin(), runs.end(), free_runs_.begin() + y, std::less_equal())) continue;  // rows too full
    for (int x = 0; x + shape.width_ <= width_;) {
      int skip = columns_to_skip(shape, clashing_row, {x, y});
      for (int r = 0; r < shape.height_ && skip == 0; ++r) {
        skip = columns_to_skip(shape, r, {x, y});
        if (skip > 0) clashing_row = r;
      }
      if (skip == 0) return V2i(x, y);
      x += skip;
    }
  }
  return std::nullopt;
}

int TexelMask::longest_run(int y, bool of_set) const {
  int longest = 0, run = 0;
  for (int x = 0; x < width_; ++x) longest = std::max(longest, run = at(x, y) == of_set ? run + 1 : 0);
  return longest;
}

/// How far the shape must at least move right from `at` until this row of it is clear of what it meets last; 0 if
/// clear.
int TexelMask::columns_to_skip(TexelMask const& shape, int shape_row, V2i at) const {
  std::span<Word const> const mine = row(at.y + shape_row), its = shape.row(shape_row);
  for (std::size_t k = its.size(); k-- > 0;)
    if (Word const clash = its[k] & moved_word(mine, k, -at.x); clash != 0)
      return run_ending_at(its, int(k) * 64 + 63 - std::countl_zero(clash));
  return 0;
}

}  // namespace vitrine
