// SPDX-License-Identifier: Apache-2.0
#include "stages/tangent_frame.h"

#include <algorithm>
#include <cmath>

namespace vitrine {
namespace {

/// The smallest z that glTF allows in a normal map, 8-bit 128.
constexpr double kLeastZ = 1.0 / 255;

/// Below this share of the longer column's square, T and B count as collinear: 8 bits could not tell them apart.
constexpr double kSingular = 1e-4;

}  // namespace

TangentFrame client_frame(std::array<V3f, 3> const& positions, CornerUvs const& uvs, V3f const& normal) {
  V3d const n(normal), q0(positions[1] - positions[0]), q1(positions[2] - positions[0]);
  V2f const st0 = uvs[1] - uvs[0], st1 = uvs[2] - uvs[0];
  V3d const t = n.cross(q0 * st1.x - q1 * st0.x), b = n.cross(q1 * st0.y - q0 * st1.y);
  double const longer = std::max(t.length2(), b.length2());
  double const scale = longer > 0 ? 1 / std::sqrt(longer) : 0;
  return {V3f(t * scale), V3f(b * scale), normal};
}

V3f to_tangent_space(TangentFrame const& frame, V3f const& wanted) {
  V3d const t(frame.tangent), b(frame.bitangent), w(wanted);
  double const tt = t.length2(), tb = t.dot(b), bb = b.length2(), wt = w.dot(t), wb = w.dot(b);
  double const determinant = tt * bb - tb * tb;
  V3d m(0, 0, w.dot(V3d(frame.normal)));
  if (determinant > kSingular) {
    m.x = (bb * wt - tb * wb) / determinant;
    m.y = (tt * wb - tb * wt) / determinant;
  } else if (tt + bb > 0) {
    m.x = wt / (tt + bb);
    m.y = wb / (tt + bb);
  }
  double const flat = std::hypot(m.x, m.y);
  m.z = flat > 0 ? std::max(m.z, kLeastZ * flat) : 1;
  return V3f(m.normalized());
}

V3f from_tangent_space(TangentFrame const& frame, V3f const& m) {
  return (frame.tangent * m.x + frame.bitangent * m.y + frame.normal * m.z).normalized();
}

}  // namespace vitrine
