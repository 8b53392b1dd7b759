// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Which vertices and triangles a part of a sample object has: a rectangle of points, joined to itself in one of a few
/// ways.

#include "stages/data.h"

#include <cstdint>

namespace vitrine::sample {

/// How the edges of the parameter rectangle (u across, v down) are joined.
enum class Topology {
  sheet,   ///< open on all sides
  tube,    ///< u comes round; open at both ends
  cap,     ///< u comes round; v = 0 is a point, v = 1 is open
  ball,    ///< u comes round; v = 0 and v = 1 are points: closed, genus 0
  torus,   ///< u and v come round: closed, genus 1
  pillow,  ///< two sheets, front and back, joined along their four edges: closed, genus 0
};

inline bool closed(Topology topology) { return topology >= Topology::ball; }

/// A place on a part: u and v in [0, 1]; `back` on the second sheet of a pillow.
struct Uv {
  double u = 0, v = 0;
  bool back = false;
};

/// Points x = 0..columns, y = 0..rows of one part; indices count row by row. `welded` indices name distinct vertices;
/// `split` ones repeat those on a seam, as texture coordinates need it.
class Grid {
 public:
  /// About `triangles` of them (at least a few), with cells `aspect` times as many across as down.
  Grid(Topology topology, double triangles, double aspect);

  std::uint32_t vertices() const { return vertices_; }
  std::uint32_t split_vertices() const { return width_ * height_ * sides_; }
  std::uint64_t triangles() const;

  Triangle split_triangle(std::uint64_t index) const;  ///< counter-clockwise where u runs right and v runs down
  std::uint32_t weld(std::uint32_t split) const;
  std::uint32_t split(std::uint32_t welded) const;  ///< the first split vertex of a welded one

  /// Where a split vertex lies. Inner points are shaken by a share of a cell, so that meshes look less like grids.
  Uv place(std::uint32_t split, std::uint32_t seed) const;

  Topology topology() const { return topology_; }

 private:
  Topology topology_;
  std::uint32_t columns_, rows_;          ///< cells
  std::uint32_t width_, height_, sides_;  ///< split points across, down, sheets
  std::uint32_t vertices_;
};

}  // namespace vitrine::sample
