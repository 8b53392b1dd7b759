// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Closest point of a triangle.

#include "stages/data.h"

#include <algorithm>
#include <limits>

namespace vitrine {

/// Barycentric weights of the second and third corner.
struct Barycentric {
  float u = 0, v = 0;
};

/// corners[0] + u (corners[1] - corners[0]) + v (corners[2] - corners[0]), for points, normals and texture coordinates.
template <class Vec>
Vec interpolate(Vec const& a, Vec const& b, Vec const& c, Barycentric const& at) {
  return a * (1 - at.u - at.v) + b * at.u + c * at.v;
}

/// Place on the triangle (0, b, c) closest to p, in two or three dimensions; a triangle without area counts as its
/// edges.
template <class Vec>
Barycentric closest_on_triangle(Vec const& p, Vec const& b, Vec const& c) {
  auto const bb = b.dot(b), bc = b.dot(c), cc = c.dot(c), pb = p.dot(b), pc = p.dot(c);
  auto const area = bb * cc - bc * bc, u = cc * pb - bc * pc, v = bb * pc - bc * pb;
  if (area > 0 && u >= 0 && v >= 0 && u + v <= area) return {float(u / area), float(v / area)};
  Barycentric best;
  auto least = std::numeric_limits<decltype(bb)>::max();
  auto const try_edge = [&](Vec const& from, Vec const& along, Barycentric const& start, Barycentric const& step) {
    auto const length = along.dot(along);
    auto const t =
        length > 0 ? std::clamp((p - from).dot(along) / length, decltype(length)(0), decltype(length)(1)) : 0;
    auto const distance = (p - from - along * t).length2();
    if (distance >= least) return;
    least = distance;
    best = {start.u + step.u * float(t), start.v + step.v * float(t)};
  };
  try_edge(Vec(0), b, {0, 0}, {1, 0});
  try_edge(Vec(0), c, {0, 0}, {0, 1});
  try_edge(b, c - b, {1, 0}, {-1, 1});
  return best;
}

}  // namespace vitrine
