// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Seeded noise over space, the same on every machine: the grain, wear and dirt of the sample objects.
/// Sources: Perlin 2002, "Improving Noise" (gradient noise); Worley 1996, "A Cellular Texture Basis Function" (cells).

#include <Imath/ImathVec.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace vitrine::sample {

using Imath::V2d;
using Imath::V3d;

/// Mixes integers into 32 evenly spread bits.
inline std::uint32_t hash(std::uint32_t a, std::uint32_t b = 0, std::uint32_t c = 0, std::uint32_t seed = 0) {
  std::uint32_t h = a * 0x8DA6B343u + b * 0xD8163841u + c * 0xCB1AB31Fu + seed * 0x9E3779B9u;
  h = (h ^ (h >> 16)) * 0x7FEB352Du;
  h = (h ^ (h >> 15)) * 0x846CA68Bu;
  return h ^ (h >> 16);
}

/// A number in [0, 1) for integers.
inline double random(std::uint32_t a, std::uint32_t b = 0, std::uint32_t c = 0, std::uint32_t seed = 0) {
  return hash(a, b, c, seed) * 0x1p-32;
}

inline double mix(double a, double b, double t) { return a + (b - a) * t; }

/// 0 below `low`, 1 above `high`, smooth between.
inline double step(double low, double high, double x) {
  double const t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// Gradient noise in about [-1, 1] with features of size 1; 0 at integer points.
inline double noise(V3d const& p, std::uint32_t seed) {
  auto const ease = [](double t) { return t * t * t * (t * (t * 6 - 15) + 10); };
  V3d const floor(std::floor(p.x), std::floor(p.y), std::floor(p.z));
  V3d const f = p - floor;
  std::uint32_t const cell[3] = {std::uint32_t(std::int64_t(floor.x)), std::uint32_t(std::int64_t(floor.y)),
                                 std::uint32_t(std::int64_t(floor.z))};
  double const weight[3] = {ease(f.x), ease(f.y), ease(f.z)};
  double sum = 0;
  for (std::uint32_t corner = 0; corner < 8; ++corner) {
    std::uint32_t const i = corner & 1, j = corner >> 1 & 1, k = corner >> 2;
    std::uint32_t const h = hash(cell[0] + i, cell[1] + j, cell[2] + k, seed) & 15;
    double const x = f.x - i, y = f.y - j, z = f.z - k;
    double const a = h < 8 ? x : y, b = h < 4 ? y : h == 12 || h == 14 ? x : z;
    double const share =
        (i ? weight[0] : 1 - weight[0]) * (j ? weight[1] : 1 - weight[1]) * (k ? weight[2] : 1 - weight[2]);
    sum += share * ((h & 1 ? -a : a) + (h & 2 ? -b : b));
  }
  return sum;
}

/// Octaves of noise, each of half the size and height of the one before; about [-1, 1].
inline double fractal(V3d p, int octaves, std::uint32_t seed) {
  double sum = 0, height = 0.5;
  for (int i = 0; i < octaves; ++i, height /= 2, p = p * 2.03 + V3d(17.1, 5.3, 11.7))
    sum += height * noise(p, seed + i);
  return sum * 1.4;
}

/// The scattered point nearest to p (one in each unit cube) and how far the nearest two are.
struct Cell {
  double nearest = 1e9, second = 1e9;
  std::uint32_t id = 0;
};
inline Cell cells(V3d const& p, std::uint32_t seed) {
  Cell cell;
  V3d const floor(std::floor(p.x), std::floor(p.y), std::floor(p.z));
  for (int k = -1; k <= 1; ++k)
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i) {
        V3d const corner = floor + V3d(i, j, k);
        std::uint32_t const id = hash(std::uint32_t(std::int64_t(corner.x)), std::uint32_t(std::int64_t(corner.y)),
                                      std::uint32_t(std::int64_t(corner.z)), seed);
        V3d const point = corner + V3d(random(id, 1), random(id, 2), random(id, 3));
        double const distance = (point - p).length();
        if (distance < cell.nearest)
          cell = {distance, cell.nearest, id};
        else
          cell.second = std::min(cell.second, distance);
      }
  return cell;
}

}  // namespace vitrine::sample
