// SPDX-License-Identifier: Apache-2.0
#include "stages/planar_face.h"

#include <algorithm>

namespace vitrine {
namespace {

/// Lays a face flat with its longest edge on the real axis; no lower than kThinnest of that edge. `unit` stands in for
/// the edge when all three corners coincide.
PlanarFace lay_flat(std::array<V3d, 3> const& p, double unit) {
  std::array<double, 3> length;
  for (std::size_t i = 0; i < 3; ++i) length[i] = (p[(i + 1) % 3] - p[i]).length();
  std::size_t const a = std::size_t(std::ranges::max_element(length) - length.begin()), b = (a + 1) % 3,
                    c = (a + 2) % 3;
  double const base = length[a];
  PlanarFace face;
  face.corners[a] = 0;
  if (base <= 0) {
    face.corners[b] = unit;
    face.corners[c] = Complex(0, unit);
    return face;
  }
  V3d const along = (p[b] - p[a]) / base;
  double const x = (p[c] - p[a]).dot(along), height = (p[c] - p[a]).cross(along).length();
  face.corners[b] = base;
  face.corners[c] = Complex(x, std::max(height, kThinnest * base));
  return face;
}

}  // namespace

std::vector<PlanarFace> lay_faces_flat(TriMesh const& disk, double size) {
  std::vector<PlanarFace> faces;
  faces.reserve(disk.triangles.size());
  for (auto const& [a, b, c] : disk.triangles)
    faces.push_back(
        lay_flat({V3d(disk.positions[a]), V3d(disk.positions[b]), V3d(disk.positions[c])}, kThinnest * size));
  return faces;
}

}  // namespace vitrine
