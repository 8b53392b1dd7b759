// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Samples side by side: plain loops over lanes become the processor's vector instructions.

#include "stages/data.h"

#include <cmath>

namespace vitrine {

constexpr std::size_t kLanes = 16;
using Lanes = std::array<float, kLanes>;
template <std::size_t kSize>
using LaneVector = std::array<Lanes, kSize>;

/// Places on one face: weights of its second and third corner, and how far they move from a pixel to its neighbours,
/// across and up. Lanes from `count` on mean nothing, here and in what is made of them.
struct Places {
  std::size_t count = 0;
  Lanes u, v;
  LaneVector<2> step_u, step_v;
};

/// first + u * second + v * third, per component.
template <std::size_t kSize, class Vector>
void interpolate(std::array<Vector, 3> const& from_first, Places const& at, LaneVector<kSize>& values) {
  for (std::size_t k = 0; k < kSize; ++k) {
    float const a = from_first[0][int(k)], b = from_first[1][int(k)], c = from_first[2][int(k)];
    for (std::size_t i = 0; i < at.count; ++i) values[k][i] = a + b * at.u[i] + c * at.v[i];
  }
}

/// To length 1. Whether all were longer than nothing; the others become 0.
inline bool make_unit(LaneVector<3>& v, std::size_t count) {
  float shortest = 1;
  for (std::size_t i = 0; i < count; ++i) {
    float const squared = v[0][i] * v[0][i] + v[1][i] * v[1][i] + v[2][i] * v[2][i];
    float const scale = squared > 1e-30f ? 1 / std::sqrt(squared) : 0;
    v[0][i] *= scale, v[1][i] *= scale, v[2][i] *= scale;
    shortest = scale < shortest ? scale : shortest;
  }
  return shortest > 0;
}

inline V3f lane(LaneVector<3> const& v, std::size_t i) { return {v[0][i], v[1][i], v[2][i]}; }
inline void set_lane(LaneVector<3>& v, std::size_t i, V3f const& value) {
  v[0][i] = value.x, v[1][i] = value.y, v[2][i] = value.z;
}

}  // namespace vitrine
