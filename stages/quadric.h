// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Sums of squared distances to planes, as functions of a point.
/// Source: Garland & Heckbert 1997, section 3.4; planes weighted by area: Garland 1999, "Quadric-Based Polygonal
/// Surface Simplification".

#include "stages/data.h"

#include <algorithm>

namespace vitrine {

/// q(x) = x'Ax - 2b'x + c with A symmetric, in the square of the unit of x times the unit of the weights.
class Quadric {
 public:
  /// Weight times the square of slope'x - value.
  static Quadric linear(V3d const& slope, double value, double weight) {
    Quadric q;
    V3d const w = slope * weight;
    q.xx_ = w.x * slope.x, q.xy_ = w.x * slope.y, q.xz_ = w.x * slope.z;
    q.yy_ = w.y * slope.y, q.yz_ = w.y * slope.z, q.zz_ = w.z * slope.z;
    q.b_ = w * value;
    q.c_ = weight * value * value;
    return q;
  }

  /// Weight times the squared distance to the plane through `point` with unit `normal`.
  static Quadric plane(V3d const& normal, V3d const& point, double weight) {
    return linear(normal, normal.dot(point), weight);
  }

  Quadric& operator+=(Quadric const& q) {
    xx_ += q.xx_, xy_ += q.xy_, xz_ += q.xz_, yy_ += q.yy_, yz_ += q.yz_, zz_ += q.zz_;
    b_ += q.b_;
    c_ += q.c_;
    return *this;
  }
  friend Quadric operator+(Quadric a, Quadric const& b) { return a += b; }

  double operator()(V3d const& x) const { return std::max(0.0, (times(x) - b_ * 2.0).dot(x) + c_); }

  /// Sum of the planes' weights.
  double weight() const { return xx_ + yy_ + zz_; }

  /// As a function of the place alone.
  Quadric const& of_place() const { return *this; }

  /// The x where q(x) + stiffness * |x - near|^2 is least: planes that leave a direction open leave x near `near`.
  V3d minimiser(V3d const& near, double stiffness) const {
    double const xx = xx_ + stiffness, yy = yy_ + stiffness, zz = zz_ + stiffness;
    V3d const row0(yy * zz - yz_ * yz_, xz_ * yz_ - xy_ * zz, xy_ * yz_ - xz_ * yy);  // of the adjugate
    V3d const row1(row0.y, xx * zz - xz_ * xz_, xy_ * xz_ - xx * yz_);
    V3d const row2(row0.z, row1.z, xx * yy - xy_ * xy_);
    double const determinant = xx * row0.x + xy_ * row0.y + xz_ * row0.z;
    V3d const downhill = b_ - times(near);
    if (!(determinant > 0)) return near;
    return near + V3d(row0.dot(downhill), row1.dot(downhill), row2.dot(downhill)) / determinant;
  }

 private:
  V3d times(V3d const& x) const {
    return {xx_ * x.x + xy_ * x.y + xz_ * x.z, xy_ * x.x + yy_ * x.y + yz_ * x.z, xz_ * x.x + yz_ * x.y + zz_ * x.z};
  }

  double xx_ = 0, xy_ = 0, xz_ = 0, yy_ = 0, yz_ = 0, zz_ = 0;
  V3d b_{0, 0, 0};
  double c_ = 0;
};

}  // namespace vitrine
