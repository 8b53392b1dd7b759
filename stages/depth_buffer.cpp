// SPDX-License-Identifier: Apache-2.0
#include "stages/depth_buffer.h"

#include <immintrin.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace vitrine {
namespace {

constexpr int kGridBits = 8, kGrid = 1 << kGridBits;
constexpr float kBeside = 4;  ///< a vertex may lie this many pictures beside it: products of edges stay below 2^60

std::int32_t on_grid(float samples) {
  return static_cast<std::int32_t>(samples * kGrid + (samples < 0 ? -0.5f : 0.5f));
}

/// The first and the last sample between two places on the grid.
int first_sample(std::int32_t low) { return (low + kGrid - 1) >> kGridBits; }
int last_sample(std::int32_t high) { return high >> kGridBits; }

/// Faces up to this many samples across have edges of 32 bits, also at the end of their last tile.
constexpr int kSmall = 59;

/// Twice the area of a triangle, on one side of an edge positive: linear in the place of its third corner.
template <class Int>
struct Edge {
  Int at, per_column, per_row;

  template <class Corner>
  Edge(Corner const& from, Corner const& to, int column, int row) {
    Int const dx = to.x - from.x, dy = to.y - from.y;
    at = dx * Int(row * kGrid - from.y) - dy * Int(column * kGrid - from.x);
    per_column = -dy * kGrid;
    per_row = dx * kGrid;
  }
};

template <class Int, class Corner>
Int twice_area(Corner const& a, Corner const& b, Corner const& c) {
  return Int(b.x - a.x) * Int(c.y - a.y) - Int(b.y - a.y) * Int(c.x - a.x);
}

/// Samples that are looked at side by side: most faces of an original lie within so few.
constexpr int kTile = 4;

/// A bit for each of 4 x 4 samples from the edges' place on, row by row: whether it lies on or within all three.
unsigned tile_within(Edge<std::int32_t> const& a, Edge<std::int32_t> const& b, Edge<std::int32_t> const& c) {
  __m256i const columns = _mm256_setr_epi32(0, 1, 2, 3, 0, 1, 2, 3), rows = _mm256_setr_epi32(0, 0, 0, 0, 1, 1, 1, 1);
  auto const at = [&](Edge<std::int32_t> const& edge) {
    return _mm256_add_epi32(_mm256_set1_epi32(edge.at),
                            _mm256_add_epi32(_mm256_mullo_epi32(columns, _mm256_set1_epi32(edge.per_column)),
                                             _mm256_mullo_epi32(rows, _mm256_set1_epi32(edge.per_row))));
  };
  auto const below = [](Edge<std::int32_t> const& edge) { return _mm256_set1_epi32(2 * edge.per_row); };
  __m256i const ea = at(a), eb = at(b), ec = at(c);
  __m256i const upper = _mm256_or_si256(_mm256_or_si256(ea, eb), ec);
  __m256i const lower = _mm256_or_si256(_mm256_or_si256(_mm256_add_epi32(ea, below(a)), _mm256_add_epi32(eb, below(b))),
                                        _mm256_add_epi32(ec, below(c)));
  auto const outside = [](__m256i edges) { return unsigned(_mm256_movemask_ps(_mm256_castsi256_ps(edges))); };
  return ~(outside(upper) | outside(lower) << 8) & 0xffffu;
}

/// An edge at a row of the tile.
__m128 row_of(Edge<std::int32_t> const& edge, int row) {
  __m128i const first = _mm_set1_epi32(edge.at + row * edge.per_row);
  return _mm_cvtepi32_ps(
      _mm_add_epi32(first, _mm_mullo_epi32(_mm_setr_epi32(0, 1, 2, 3), _mm_set1_epi32(edge.per_column))));
}

/// Of samples side by side, those whose bits are set become what is nearer.
void put_row(std::uint64_t* samples, __m128 nearness, std::uint32_t id, unsigned which) {
  __m256i const bits = _mm256_setr_epi64x(1, 2, 4, 8);
  __m256i const within = _mm256_cmpeq_epi64(_mm256_and_si256(_mm256_set1_epi64x(which), bits), bits);
  __m256i const depths = _mm256_slli_epi64(_mm256_cvtepu32_epi64(_mm_castps_si128(nearness)), 32);
  __m256i const drawn = _mm256_or_si256(depths, _mm256_set1_epi64x(id));
  __m256i const there = _mm256_loadu_si256(reinterpret_cast<__m256i const*>(samples));
  __m256i const nearer = _mm256_and_si256(within, _mm256_cmpgt_epi64(drawn, there));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(samples), _mm256_blendv_epi8(there, drawn, nearer));
}

}  // namespace

Lens::Lens(Camera const& camera, V3d const& origin, int of)
    : eye(camera.eye - origin), forward(camera.forward), near(float(camera.near)), far(float(camera.far)), side(of) {
  double const step = 2.0 / of;
  right = V3f(through(camera, step, 0) - camera.forward);
  up = V3f(through(camera, 0, step) - camera.forward);
  top_left = V3f(through(camera, step / 2 - 1, 1 - step / 2));
}

DepthBuffer::DepthBuffer(int side)
    : side_(side), samples_(std::make_unique_for_overwrite<Sample[]>(std::size_t(side) * std::size_t(side) + kTile)) {}

bool DepthBuffer::draw(TriMesh const& mesh, Lens const& lens) {
  if (!project(mesh, lens)) return false;
  clear();
  constexpr std::size_t kAhead = 8;  // faces, whose samples are fetched while others are drawn
  std::size_t const faces = mesh.triangles.size();
  for (std::size_t f = 0; f < faces; ++f) {
    fetch(corners_[mesh.triangles[std::min(f + kAhead, faces - 1)][0]]);
    Triangle const& t = mesh.triangles[f];
    draw(static_cast<std::uint32_t>(f), corners_[t[0]], corners_[t[1]], corners_[t[2]]);
  }
  return true;
}

bool DepthBuffer::project(TriMesh const& mesh, Lens const& lens) {
  V3f const per_column = lens.right / lens.right.length2(), per_row = lens.up / -lens.up.length2();
  float const column0 = -lens.top_left.dot(per_column), row0 = -lens.top_left.dot(per_row);
  float const beside = kBeside * float(side_);
  std::int32_t low_x = std::numeric_limits<std::int32_t>::max(), high_x = -low_x, low_y = low_x, high_y = -low_x;
  corners_.resize(mesh.positions.size());
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    V3f const q = mesh.positions[i] - lens.eye;
    float const depth = q.dot(lens.forward), nearness = 1 / depth;
    float const column = q.dot(per_column) * nearness + column0, row = q.dot(per_row) * nearness + row0;
    if (!(depth >= lens.near && depth <= lens.far && std::abs(column) < beside && std::abs(row) < beside)) return false;
    corners_[i] = {on_grid(column), on_grid(row), nearness};
    low_x = std::min(low_x, corners_[i].x), high_x = std::max(high_x, corners_[i].x);
    low_y = std::min(low_y, corners_[i].y), high_y = std::max(high_y, corners_[i].y);
  }
  left_ = std::max(first_sample(low_x), 0), right_ = std::min(last_sample(high_x), side_ - 1);
  top_ = std::max(first_sample(low_y), 0), bottom_ = std::min(last_sample(high_y), side_ - 1);
  return true;
}

void DepthBuffer::clear() {
  if (right_ < left_) return;
  for (int row = top_; row <= bottom_; ++row)
    std::fill_n(&samples_[std::size_t(row) * std::size_t(side_) + std::size_t(left_)], right_ - left_ + 1, Sample{0});
}

void DepthBuffer::draw(std::uint32_t id, Corner const& a, Corner const& b, Corner const& c) {
  std::int32_t const low_x = std::min({a.x, b.x, c.x}), high_x = std::max({a.x, b.x, c.x});
  Cells cells{std::max(first_sample(low_x), 0), std::min(last_sample(high_x), side_ - 1), 0, 0};
  if (cells.left > cells.right) return;
  std::int32_t const low_y = std::min({a.y, b.y, c.y}), high_y = std::max({a.y, b.y, c.y});
  cells.top = std::max(first_sample(low_y), 0), cells.bottom = std::min(last_sample(high_y), side_ - 1);
  if (cells.top > cells.bottom) return;
  if (std::max(high_x - low_x, high_y - low_y) <= kSmall * kGrid)
    fill_tiles(id, a, b, c, cells);
  else
    fill(id, a, b, c, cells);
}

inline void DepthBuffer::fetch(Corner const& at) const {
  int const column = std::clamp(at.x >> kGridBits, 0, side_ - 1), row = std::clamp(at.y >> kGridBits, 0, side_ - 1);
  __builtin_prefetch(&samples_[std::size_t(row) * std::size_t(side_) + std::size_t(column)], 1);
}

inline void DepthBuffer::put(int column, int row, float nearness, std::uint32_t id) {
  Sample& sample = samples_[std::size_t(row) * std::size_t(side_) + std::size_t(column)];
  sample = std::max(sample, Sample{std::bit_cast<std::uint32_t>(nearness)} << 32 | id);
}

void DepthBuffer::fill(std::uint32_t id, Corner const& a, Corner b, Corner c, Cells const& cells) {
  std::int64_t area = twice_area<std::int64_t>(a, b, c);
  if (area == 0) return;
  if (area < 0) std::swap(b, c), area = -area;
  auto const& [left, right, top, bottom] = cells;
  Edge<std::int64_t> across_a(b, c, left, top), across_b(c, a, left, top), across_c(a, b, left, top);
  float const per_b = (b.nearness - a.nearness) / float(area), per_c = (c.nearness - a.nearness) / float(area);
  for (int row = top; row <= bottom; ++row) {
    std::int64_t ea = across_a.at, eb = across_b.at, ec = across_c.at;
    for (int column = left; column <= right; ++column) {
      if ((ea | eb | ec) >= 0) put(column, row, a.nearness + per_b * float(eb) + per_c * float(ec), id);
      ea += across_a.per_column, eb += across_b.per_column, ec += across_c.per_column;
    }
    across_a.at += across_a.per_row, across_b.at += across_b.per_row, across_c.at += across_c.per_row;
  }
}

/// The same for small faces, kTile x kTile samples at once.
void DepthBuffer::fill_tiles(std::uint32_t id, Corner const& a, Corner b, Corner c, Cells const& cells) {
  std::int32_t area = twice_area<std::int32_t>(a, b, c);
  if (area == 0) return;
  if (area < 0) std::swap(b, c), area = -area;
  float per_b = 0, per_c = 0;
  for (int top = cells.top; top <= cells.bottom; top += kTile)
    for (int left = cells.left; left <= cells.right; left += kTile) {
      Edge<std::int32_t> const across_a(b, c, left, top), across_b(c, a, left, top), across_c(a, b, left, top);
      int const columns = std::min(cells.right - left + 1, kTile), rows = std::min(cells.bottom - top + 1, kTile);
      unsigned within =
          tile_within(across_a, across_b, across_c) & 0x1111u * ((1u << columns) - 1) & ((1u << kTile * rows) - 1);
      if (within == 0) continue;
      if (per_b == 0 && per_c == 0)
        per_b = (b.nearness - a.nearness) / float(area), per_c = (c.nearness - a.nearness) / float(area);
      for (int row = 0; within != 0; ++row, within >>= kTile) {
        if (within % (1u << kTile) == 0) continue;
        __m128 const nearness =
            _mm_add_ps(_mm_add_ps(_mm_set1_ps(a.nearness), _mm_mul_ps(_mm_set1_ps(per_b), row_of(across_b, row))),
                       _mm_mul_ps(_mm_set1_ps(per_c), row_of(across_c, row)));
        put_row(&samples_[std::size_t(top + row) * std::size_t(side_) + std::size_t(left)], nearness, id, within);
      }
    }
}

}  // namespace vitrine
