// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Moves a mesh onto the grid that the file will store, before anything is baked for it.

#include "stages/data.h"
#include "stages/options.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vitrine {

struct QuantizeOptions {
  int position_bits = 11;
  int uv_bits = 11;
  int normal_bits = 8;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(self.position_bits, Field{"position-bits", "bits", "of each stored coordinate", 6, 16});
    visit(self.uv_bits, Field{"uv-bits", "bits", "of each stored texture coordinate", 6, 16});
    visit(self.normal_bits, Field{"normal-bits", "bits", "of each stored normal's two octahedral coordinates", 4, 14});
  }
};

/// One coordinate's codes 0 ... last() over [origin, origin + range]. Draco computes in float, so do we.
class AxisCodes {
 public:
  AxisCodes(float origin, float range, int bits) : origin_(origin), range_(range), last_((1 << bits) - 1) {}

  int code(float value) const {  ///< the nearest
    float const inverse_step = float(last_) / range_;
    return std::clamp(int(std::floor((value - origin_) * inverse_step + 0.5f)), 0, last_);
  }
  float value(int code) const { return float(code) * (range_ / float(last_)) + origin_; }
  int last() const { return last_; }

 private:
  float origin_, range_;
  int last_;
};

/// The places of a grid for positions.
class GridCodes {
 public:
  explicit GridCodes(Grid const& grid)
      : axes_{AxisCodes(grid.origin.x, grid.range, grid.position_bits),
              AxisCodes(grid.origin.y, grid.range, grid.position_bits),
              AxisCodes(grid.origin.z, grid.range, grid.position_bits)} {}

  Imath::V3i code(V3f const& p) const { return {axes_[0].code(p.x), axes_[1].code(p.y), axes_[2].code(p.z)}; }
  V3f value(Imath::V3i const& c) const { return {axes_[0].value(c.x), axes_[1].value(c.y), axes_[2].value(c.z)}; }
  int last() const { return axes_[0].last(); }  ///< the largest code

 private:
  std::array<AxisCodes, 3> axes_;
};

/// The grid of the smallest axis-aligned cube about the mesh that begins at its bounding box's corner. No uv or normal
/// bits.
/// Errors: NoSolution when the mesh is but a point.
Grid cube_about(TriMesh const& mesh, int position_bits);

/// The same mesh on its grid, for meshes without an atlas.
struct QuantizedMesh {
  TriMesh mesh;
  Grid grid;
};

/// Snaps positions to the grid, see below. Vertices that meet are one, in the order of their first use.
/// Errors: NoSolution when no face is left.
QuantizedMesh quantize(TriMesh mesh, Grid const& grid);

/// Snaps positions and texture coordinates to the values that Draco's explicit quantisation decodes to, bit for bit:
/// origin + i * (range / (2^bits - 1)) in float arithmetic, i the nearest integer.
/// Out:    positions in a cube about the mesh, uvs in the unit square; vertices that meet are one, in the order of
///         their first use; faces that lose their area are dropped, `fill` stays as it was.
/// Errors: LimitExceeded when a step of the uvs is longer than the atlas's gutter, as charts could then overlap;
///         NoSolution when no face is left.
QuantizedAtlas quantize(Atlas atlas, QuantizeOptions const& options = {});

/// The unit vector that Draco's octahedral code of `bits` decodes to for this one, bit for bit.
/// Source: Cigolle et al. 2014, "A Survey of Efficient Representations for Independent Unit Vectors"; the octahedron is
/// unfolded around +X, and has 2^bits - 1 codes a side.
V3f quantize_normal(V3f const& normal, int bits);

}  // namespace vitrine
