// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Faces before an eye, and where rays through samples of a picture meet them. Internal to render.

#include "stages/depth_buffer.h"
#include "stages/surface.h"

#include <array>
#include <memory>

namespace vitrine {

/// Rays through samples of a picture, side by side.
struct Rays {
  std::size_t count = 0;
  Lanes column, row;
};

/// A face before the eye: the place where a ray of direction d meets it is (d.u, d.v) / d.across.
struct SeenFace {
  Facet facet;
  V3f u, v;

  SeenFace() = default;
  SeenFace(Surface const& surface, std::uint32_t face, V3f const& eye) : facet(surface.facet(face)) {
    auto const& p = facet.corners;
    V3f const from_first = eye - p[0];
    u = from_first.cross(p[2] - p[0]), v = (p[1] - p[0]).cross(from_first);
  }

  /// Where rays meet the face; within it also where they pass by, by what the depth buffer rounds.
  /// `facing`: 1, or -1 where it is seen from behind.
  void meet(Rays const& rays, Lens const& lens, Places& at, Lanes& facing) const {
    Product const across(facet.across, lens), to_u(u, lens), to_v(v, lens);
    at.count = rays.count;
    for (std::size_t i = 0; i < rays.count; ++i) {
      float const column = rays.column[i], row = rays.row[i], slope = across(column, row), scale = 1 / slope;
      float const met_u = to_u(column, row) * scale, met_v = to_v(column, row) * scale;
      float const low_u = met_u > 0 ? met_u : 0, in_u = low_u < 1 ? low_u : 1;
      float const low_v = met_v > 0 ? met_v : 0, in_v = low_v < 1 - in_u ? low_v : 1 - in_u;
      at.u[i] = in_u, at.v[i] = in_v;
      facing[i] = slope > 0 ? -1.f : 1.f;
      at.step_u[0][i] = (to_u.right - in_u * across.right) * scale;
      at.step_v[0][i] = (to_v.right - in_v * across.right) * scale;
      at.step_u[1][i] = (to_u.down - in_u * across.down) * scale;
      at.step_v[1][i] = (to_v.down - in_v * across.down) * scale;
    }
  }

 private:
  /// Of a vector and the direction of rays: linear in column and row.
  struct Product {
    float top_left, right, down;

    Product(V3f const& with, Lens const& lens)
        : top_left(with.dot(lens.top_left)), right(with.dot(lens.right)), down(-with.dot(lens.up)) {}
    float operator()(float column, float row) const { return top_left + right * column + down * row; }
  };
};

/// The faces seen last, by the low bits of their number.
class SeenFaces {
 public:
  SeenFaces(Surface const& surface, V3f const& eye) : surface_(surface), eye_(eye) {}

  SeenFace const& operator[](std::uint32_t face) {
    SeenFace& seen = faces_[face % faces_.size()];
    if (seen.facet.face != face) std::construct_at(&seen, surface_, face, eye_);
    return seen;
  }

 private:
  Surface const& surface_;
  V3f eye_;
  std::array<SeenFace, 64> faces_;
};

}  // namespace vitrine
