// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Faces of a disk, each in its own plane. Internal to the maps that lay charts flat.

#include "stages/data.h"

#include <array>
#include <complex>
#include <vector>

namespace vitrine {

using Complex = std::complex<double>;

inline constexpr double kThinnest =
    1e-6;  ///< height of a sliver as a share of its longest edge; shares of the chart's size below are noise

inline double cross(Complex a, Complex b) { return a.real() * b.imag() - a.imag() * b.real(); }

/// The corners of a face in its own plane, counter-clockwise.
struct PlanarFace {
  std::array<Complex, 3> corners;
  double area() const { return cross(corners[1] - corners[0], corners[2] - corners[0]) / 2; }
};

/// One per face of a disk of this size, see kThinnest.
std::vector<PlanarFace> lay_faces_flat(TriMesh const& disk, double size);

/// Between the plane and texture coordinates, whose v points down.
inline Complex plane(V2f const& uv) { return {uv.x, -double(uv.y)}; }

}  // namespace vitrine
