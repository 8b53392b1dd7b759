// SPDX-License-Identifier: Apache-2.0
#include "stages/tangent_frame.h"

#include <Imath/ImathVec.h>

#include <algorithm>
#include <cmath>

namespace vitrine {
namespace {

using Imath::V2d;

/// The smallest z that glTF allows in a normal map, 8-bit 128.
constexpr double kLeastZ = 1.0 / 255;

/// Below this share of the longer column's square, T and B count as collinear: 8 bits could not tell them apart.
constexpr double kSingular = 1e-4;

/// Below this share of N across the plane of T and B, T counts as lying along N: what m.x shows could not be told.
constexpr double kUpright = 0.1;

/// The direction that m.z alone adds to, perpendicular to T and B; N itself where they span no plane that N leaves.
V3d upwards(TangentFrame const& frame) {
  V3d const n(frame.normal), across = V3d(frame.tangent).cross(V3d(frame.bitangent));
  bool const spans = across.length2() > kSingular && std::abs(across.normalized().dot(n)) > kUpright;
  return spans ? across : n;
}

/// The (x, y) for which x T + y B comes nearest to `wanted`; the shortest of them.
V2d in_plane(TangentFrame const& frame, V3d const& wanted) {
  V3d const t(frame.tangent), b(frame.bitangent);
  double const tt = t.length2(), tb = t.dot(b), bb = b.length2(), wt = wanted.dot(t), wb = wanted.dot(b);
  double const determinant = tt * bb - tb * tb;
  if (determinant > kSingular) return V2d(bb * wt - tb * wb, tt * wb - tb * wt) / determinant;
  return tt + bb > 0 ? V2d(wt, wb) / (tt + bb) : V2d(0, 0);
}

V3f unit(V3f const& v) {
  float const squared = v.length2();
  return squared > 0 ? v * (1 / std::sqrt(squared)) : v;
}

}  // namespace

TangentFrame client_frame(std::array<V3f, 3> const& positions, CornerUvs const& uvs, V3f const& normal) {
  V3d const n(normal), q0(positions[1] - positions[0]), q1(positions[2] - positions[0]);
  V2f const st0 = uvs[1] - uvs[0], st1 = uvs[2] - uvs[0];
  V3d const t = n.cross(q0 * st1.x - q1 * st0.x), b = n.cross(q1 * st0.y - q0 * st1.y);
  double const longer = std::max(t.length2(), b.length2());
  double const scale = longer > 0 ? 1 / std::sqrt(longer) : 0;
  return {V3f(t * scale), V3f(b * scale), normal};
}

TangentFrame stored_frame(V3f const& normal, V3f const& tangent) {
  V3f const along = unit(tangent);
  return {along, unit(normal.cross(along)), normal};
}

V3f to_tangent_space(TangentFrame const& frame, V3f const& wanted) {
  V3d const n(frame.normal), w(wanted);
  V3d const up = upwards(frame);
  double const z = std::max(w.dot(up) / n.dot(up), 0.0);
  V2d const xy = in_plane(frame, w - n * z);
  double const flat = xy.length();
  return V3f(V3d(xy.x, xy.y, flat > 0 ? std::max(z, kLeastZ * flat) : 1).normalized());
}

V3f from_tangent_space(TangentFrame const& frame, V3f const& m) {
  return unit(frame.tangent * m.x + frame.bitangent * m.y + frame.normal * m.z);
}

LaneVector<3> in_stored_frames(LaneVector<4> const& tangents, LaneVector<3> const& n, LaneVector<3> const& m,
                               std::size_t count) {
  LaneVector<3> t{tangents[0], tangents[1], tangents[2]}, b, shown;
  make_unit(t, count);
  for (std::size_t i = 0; i < count; ++i) {
    b[0][i] = n[1][i] * t[2][i] - n[2][i] * t[1][i];
    b[1][i] = n[2][i] * t[0][i] - n[0][i] * t[2][i];
    b[2][i] = n[0][i] * t[1][i] - n[1][i] * t[0][i];
  }
  make_unit(b, count);
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < count; ++i) {
      float const side = tangents[3][i] < 0 ? -1.f : 1.f;
      shown[k][i] = t[k][i] * m[0][i] + b[k][i] * (side * m[1][i]) + n[k][i] * m[2][i];
    }
  make_unit(shown, count);
  return shown;
}

}  // namespace vitrine
