// SPDX-License-Identifier: Apache-2.0
#include "tools/sample/grid.h"

#include "tools/sample/noise.h"

namespace vitrine::sample {
namespace {

bool turns(Topology topology) { return topology != Topology::sheet && topology != Topology::pillow; }

int poles(Topology topology) { return topology == Topology::ball ? 2 : topology == Topology::cap ? 1 : 0; }

std::uint32_t count_vertices(Topology topology, std::uint32_t columns, std::uint32_t rows) {
  switch (topology) {
    case Topology::sheet:
      return (columns + 1) * (rows + 1);
    case Topology::tube:
      return columns * (rows + 1);
    case Topology::cap:
      return columns * rows + 1;
    case Topology::ball:
      return columns * (rows - 1) + 2;
    case Topology::torus:
      return columns * rows;
    case Topology::pillow:
      return (columns + 1) * (rows + 1) + (columns - 1) * (rows - 1);
  }
  return 0;
}

}  // namespace

Grid::Grid(Topology topology, double triangles, double aspect) : topology_(topology) {
  double const cells = std::max(9.0, triangles / (topology == Topology::pillow ? 4 : 2));
  columns_ = std::uint32_t(std::clamp(std::round(std::sqrt(cells * aspect)), 3.0, cells / 3));
  rows_ = std::uint32_t(std::max(3.0, std::round(cells / columns_ + 0.5 * poles(topology))));
  width_ = columns_ + 1;
  height_ = rows_ + 1;
  sides_ = topology == Topology::pillow ? 2 : 1;
  vertices_ = count_vertices(topology, columns_, rows_);
}

std::uint64_t Grid::triangles() const {
  return std::uint64_t(columns_) * (2 * std::uint64_t(rows_) * sides_ - poles(topology_));
}

Triangle Grid::split_triangle(std::uint64_t index) const {
  std::uint64_t const side_triangles = triangles() / sides_;
  std::uint32_t const back = index >= side_triangles;
  // A row at a pole has one triangle a cell: pretend that the first row's other ones came before.
  std::uint64_t const k = index - back * side_triangles + (poles(topology_) > 0 ? columns_ : 0);
  bool const first_row = poles(topology_) > 0 && k < 2 * std::uint64_t(columns_);
  bool const last_row = poles(topology_) == 2 && k >= 2 * std::uint64_t(columns_) * (rows_ - 1);
  std::uint64_t const cell = first_row ? k - columns_ : last_row ? columns_ * (rows_ - 1ull) + k % columns_ : k / 2;
  bool const lower = first_row || (!last_row && k % 2 == 1);
  auto const x = std::uint32_t(cell % columns_), y = std::uint32_t(cell / columns_);
  std::uint32_t const a = back * width_ * height_ + y * width_ + x, b = a + 1, c = a + width_, d = c + 1;
  Triangle triangle = lower ? Triangle{b, c, d} : Triangle{a, c, b};
  if (back) std::swap(triangle[1], triangle[2]);
  return triangle;
}

std::uint32_t Grid::weld(std::uint32_t split) const {
  std::uint32_t const sheet = width_ * height_;
  std::uint32_t const x = split % width_, y = split / width_ % height_;
  switch (topology_) {
    case Topology::sheet:
      return split;
    case Topology::tube:
      return y * columns_ + x % columns_;
    case Topology::cap:
      return y == 0 ? 0 : 1 + (y - 1) * columns_ + x % columns_;
    case Topology::ball:
      return y == 0 ? 0 : y == rows_ ? vertices_ - 1 : 1 + (y - 1) * columns_ + x % columns_;
    case Topology::torus:
      return y % rows_ * columns_ + x % columns_;
    case Topology::pillow: {
      bool const edge = x == 0 || x == columns_ || y == 0 || y == rows_;
      return split < sheet ? split : edge ? split - sheet : sheet + (y - 1) * (columns_ - 1) + x - 1;
    }
  }
  return 0;
}

std::uint32_t Grid::split(std::uint32_t welded) const {
  auto const at = [&](std::uint32_t x, std::uint32_t y) { return y * width_ + x; };
  std::uint32_t const sheet = width_ * height_;
  switch (topology_) {
    case Topology::sheet:
      return welded;
    case Topology::tube:
    case Topology::torus:
      return at(welded % columns_, welded / columns_);
    case Topology::cap:
    case Topology::ball:
      return welded == 0 ? 0 : at((welded - 1) % columns_, 1 + (welded - 1) / columns_);
    case Topology::pillow: {
      if (welded < sheet) return welded;
      std::uint32_t const inner = welded - sheet;
      return sheet + at(1 + inner % (columns_ - 1), 1 + inner / (columns_ - 1));
    }
  }
  return 0;
}

Uv Grid::place(std::uint32_t split, std::uint32_t seed) const {
  std::uint32_t const x = split % width_, y = split / width_ % height_;
  double const shake = 0.5;
  std::uint32_t const own_x = turns(topology_) ? x % columns_ : x, own_y = topology_ == Topology::torus ? y % rows_ : y;
  auto const shaken = [&](std::uint32_t i, std::uint32_t n, std::uint32_t axis) {
    bool const inner = i > 0 && i < n;
    return (i + (inner ? shake * (random(own_x, own_y, axis, seed) - 0.5) : 0)) / n;
  };
  return {shaken(x, columns_, 0), shaken(y, rows_, 1), split >= width_ * height_};
}

}  // namespace vitrine::sample
