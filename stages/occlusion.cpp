// SPDX-License-Identifier: Apache-2.0
#include "stages/occlusion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vitrine {
namespace {

/// Mixes all bits into all others. Source: the finaliser of MurmurHash3, Appleby 2011.
std::uint32_t scramble(std::uint32_t x) {
  x = (x ^ (x >> 16)) * 0x85ebca6bu;
  x = (x ^ (x >> 13)) * 0xc2b2ae35u;
  return x ^ (x >> 16);
}

/// Bits in reverse order: the radical inverse in base 2, as a share of 2^32.
std::uint32_t reverse(std::uint32_t x) {
  x = (x << 16) | (x >> 16);
  x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
  x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
  x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
  return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
}

float unit(std::uint32_t x) { return float(x >> 8) / 16777216.f; }

/// Any two unit vectors that make a right-handed frame with n. Source: Duff et al. 2017, "Building an Orthonormal
/// Basis, Revisited".
struct Basis {
  V3f x, y;
  explicit Basis(V3f const& n) {
    float const sign = std::copysign(1.f, n.z), a = -1 / (sign + n.z), b = n.x * n.y * a;
    x = {1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
    y = {b, sign + n.y * n.y * a, -n.y};
  }
};

}  // namespace

float visibility(RayScene const& scene, V3f const& point, V3f const& normal, float offset, int rays,
                 std::uint32_t pattern) {
  Basis const basis(normal);
  V3f const origin = point + normal * offset;
  std::uint32_t const shift_a = scramble(2 * pattern), shift_b = scramble(2 * pattern + 1);
  int seen = 0;
  for (int i = 0; i < rays; ++i) {
    float const a = (float(i) + unit(shift_a)) / float(rays), b = unit(reverse(std::uint32_t(i)) + shift_b);
    float const radius = std::sqrt(a), angle = 2 * std::numbers::pi_v<float> * b;
    V3f const direction = basis.x * (radius * std::cos(angle)) + basis.y * (radius * std::sin(angle)) +
                          normal * std::sqrt(std::max(0.f, 1 - a));
    seen += !scene.occluded({origin, direction});
  }
  return float(seen) / float(rays);
}

}  // namespace vitrine
