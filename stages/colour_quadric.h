// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Quadrics that also sum how far a vertex's colour would be from what its faces had there.
/// Source: Hoppe 1999, "New Quadric Metric for Simplifying Meshes with Appearance Attributes": faces measure colour at
/// the projected point, and the block of the matrix that belongs to the colours is a multiple of one.

#include "stages/quadric.h"

#include <array>

namespace vitrine {

/// The colour itself, chosen best for each place, is eliminated. Colours count in units of length.
class ColourQuadric {
 public:
  static ColourQuadric plane(V3d const& normal, V3d const& point, double weight) {
    ColourQuadric q;
    q.sum_ = Quadric::plane(normal, point, weight);
    q.weight_ = weight;
    return q;
  }

  /// Adds the colours at the corners of a face of this normal, twice as large as its part in weight().
  void add_colours(std::array<V3d, 3> const& corners, std::array<V3d, 3> const& colours, double weight) {
    V3d const b = corners[1] - corners[0], c = corners[2] - corners[0], normal = b.cross(c);
    double const area2 = normal.length2();
    if (!(area2 > 0)) return;
    V3d const along_b = c.cross(normal) / area2, along_c = normal.cross(b) / area2;
    for (int k = 0; k < 3; ++k) {
      V3d const slope = along_b * (colours[1][k] - colours[0][k]) + along_c * (colours[2][k] - colours[0][k]);
      double const start = colours[0][k] - slope.dot(corners[0]);
      sum_ += Quadric::linear(slope, -start, weight);
      slopes_[k] += slope * weight;
      starts_[k] += start * weight;
    }
    coloured_ += weight;
  }

  ColourQuadric& operator+=(ColourQuadric const& q) {
    sum_ += q.sum_;
    for (int k = 0; k < 3; ++k) slopes_[k] += q.slopes_[k], starts_[k] += q.starts_[k];
    weight_ += q.weight_;
    coloured_ += q.coloured_;
    return *this;
  }
  friend ColourQuadric operator+(ColourQuadric a, ColourQuadric const& b) { return a += b; }

  double weight() const { return weight_; }

  /// As a function of the place alone: with the colour that is best there.
  Quadric of_place() const {
    Quadric q = sum_;
    if (coloured_ > 0)
      for (int k = 0; k < 3; ++k) q += Quadric::linear(slopes_[k] / coloured_, -starts_[k] / coloured_, -coloured_);
    return q;
  }

 private:
  Quadric sum_;
  std::array<V3d, 3> slopes_{V3d(0), V3d(0), V3d(0)};  ///< of the colours over space, times weight
  std::array<double, 3> starts_{};                     ///< their values at the origin, times weight
  double weight_ = 0, coloured_ = 0;
};

}  // namespace vitrine
