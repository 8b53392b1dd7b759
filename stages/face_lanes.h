// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Faces side by side, one a lane, each met by a ray of its own: where faces are as small as samples, what is computed
/// per face costs more than what is computed per sample.

#include "stages/depth_buffer.h"
#include "stages/shade.h"
#include "stages/surface.h"

#include <optional>

namespace vitrine {

/// Faces that no texture covers, of a model with normals. The same values as Surface::sample, bit by bit.
class FaceLanes {
 public:
  FaceLanes() { lit_.fill(1); }

  /// `eye`: where all rays start.
  void set_shape(std::size_t lane, SourceModel const& model, std::uint32_t face, V3f const& eye) {
    auto const& [a, b, c] = model.mesh.triangles[face];
    V3f const p = model.mesh.positions[a], n = model.normals[a];
    set_lane(to_eye_, lane, eye - p);
    set_lane(along_b_, lane, model.mesh.positions[b] - p);
    set_lane(along_c_, lane, model.mesh.positions[c] - p);
    set_lane(normals_[0], lane, n);
    set_lane(normals_[1], lane, model.normals[b] - n);
    set_lane(normals_[2], lane, model.normals[c] - n);
  }
  void set_colours(std::size_t lane, Facet const& facet) {
    for (std::size_t k = 0; k < 3; ++k)
      set_lane(colours_[k], lane, {facet.colours[k][0], facet.colours[k][1], facet.colours[k][2]});
    lit_[lane] = facet.material->unlit ? 0.f : 1.f;
  }

  /// The face of the lane before.
  void repeat(std::size_t lane) {
    for (LaneVector<3>* vector : {&to_eye_, &along_b_, &along_c_, &normals_[0], &normals_[1], &normals_[2],
                                  &colours_[0], &colours_[1], &colours_[2]})
      for (Lanes& component : *vector) component[lane] = component[lane - 1];
    lit_[lane] = lit_[lane - 1];
  }

  /// What rays through these columns and rows see, all lanes; where `colour` is given, in that.
  void look(Lens const& lens, Lanes const& column, Lanes const& row, std::optional<float> colour,
            Samples& samples) const {
    LaneVector<3> const across = cross(along_b_, along_c_);
    Lanes const slope = along_rays(across, lens, column, row);
    Lanes u = along_rays(cross(to_eye_, along_c_), lens, column, row),
          v = along_rays(cross(along_b_, to_eye_), lens, column, row);
    for (std::size_t i = 0; i < kLanes; ++i) {
      float const scale = 1 / slope[i], met_u = u[i] * scale, met_v = v[i] * scale;
      float const low_u = met_u > 0 ? met_u : 0, in_u = low_u < 1 ? low_u : 1;
      float const low_v = met_v > 0 ? met_v : 0;
      u[i] = in_u, v[i] = low_v < 1 - in_u ? low_v : 1 - in_u;
    }
    interpolate(normals_, u, v, samples.normal);
    if (!make_unit(samples.normal, kLanes)) mend(samples.normal, across);
    if (!colour) interpolate(colours_, u, v, samples.colour);
    if (colour)
      for (Lanes& channel : samples.colour) channel.fill(*colour);
    for (std::size_t i = 0; i < kLanes; ++i) {
      float const facing = slope[i] > 0 ? -1.f : 1.f;
      for (std::size_t k = 0; k < 3; ++k) samples.normal[k][i] *= facing;
      samples.lit[i] = lit_[i], samples.open[i] = 1;
    }
  }

 private:
  static LaneVector<3> cross(LaneVector<3> const& a, LaneVector<3> const& b) {
    LaneVector<3> c;
    for (std::size_t k = 0; k < 3; ++k) {
      std::size_t const l = (k + 1) % 3, m = (k + 2) % 3;
      for (std::size_t i = 0; i < kLanes; ++i) c[k][i] = a[l][i] * b[m][i] - a[m][i] * b[l][i];
    }
    return c;
  }

  static Lanes dot(LaneVector<3> const& a, V3f const& b) {
    Lanes products;
    for (std::size_t i = 0; i < kLanes; ++i) products[i] = a[0][i] * b.x + a[1][i] * b.y + a[2][i] * b.z;
    return products;
  }

  /// The products with the directions of the rays.
  static Lanes along_rays(LaneVector<3> const& a, Lens const& lens, Lanes const& column, Lanes const& row) {
    Lanes const top_left = dot(a, lens.top_left), right = dot(a, lens.right), up = dot(a, lens.up);
    Lanes products;
    for (std::size_t i = 0; i < kLanes; ++i) products[i] = top_left[i] + right[i] * column[i] + -up[i] * row[i];
    return products;
  }

  static void interpolate(std::array<LaneVector<3>, 3> const& from_first, Lanes const& u, Lanes const& v,
                          LaneVector<3>& values) {
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t i = 0; i < kLanes; ++i)
        values[k][i] = from_first[0][k][i] + from_first[1][k][i] * u[i] + from_first[2][k][i] * v[i];
  }

  static void mend(LaneVector<3>& normals, LaneVector<3> const& across) {
    for (std::size_t i = 0; i < kLanes; ++i)
      if (lane(normals, i) == V3f(0)) set_lane(normals, i, lane(across, i).normalized());
  }

  LaneVector<3> to_eye_, along_b_, along_c_;
  std::array<LaneVector<3>, 3> normals_, colours_{};  ///< as in Facet
  Lanes lit_;
};

}  // namespace vitrine
