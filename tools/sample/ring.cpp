// SPDX-License-Identifier: Apache-2.0
#include "tools/sample/draw.h"
#include "tools/sample/objects.h"

namespace vitrine::sample {
namespace {

constexpr double kFinger = 9.2;

/// 1 on the bezel, 0 on the shank; v = 0.5 is the top of the ring.
double bezel(double v) { return step(0.17, 0.1, std::abs(v - 0.5)); }

V3d place(Uv const& uv, std::uint32_t seed) {
  double const top = bezel(uv.v), section = 2 * kPi * uv.u, angle = 2 * kPi * (uv.v - 0.25);
  double const c = std::cos(section), s = std::sin(section),
               square = std::pow(std::pow(std::abs(c), 4) + std::pow(std::abs(s), 4), -0.25);
  double const wide = mix(2.1, 6.2 * std::sqrt(std::max(0.05, 1 - std::pow((uv.v - 0.5) / 0.17, 2))), top),
               thick = mix(0.95, 1.5, top);
  double const radius = kFinger + thick + thick * c * square;
  V3d p(radius * std::cos(angle), radius * std::sin(angle), wide * s * square);
  double const flat = kFinger + 2.6;  // the bezel's face is cut level
  if (top > 0 && c > 0) p.y = mix(p.y, std::min(p.y, flat + 0.5 * std::max(0.0, 1 - p.x * p.x / 60)), top);
  return p * (1 + 0.004 * noise(p * 0.15, seed));
}

/// Leans back, so that the bezel looks up to the front.
V3d lean(V3d const& p) {
  double const c = std::cos(0.75), s = std::sin(0.75);
  return {p.x, p.y * c - p.z * s, p.y * s + p.z * c};
}

/// A ship under sail between two dots, cut into the bezel; depth 0..1.
double device(V2d p) {
  double const hull = std::max(ellipse(p, {0, -0.9}, {3.3, 1.5}), p.y + 1);
  double depth = cushion(hull, 0.5);
  auto const cut = [&](double distance, double width) { depth = std::max(depth, cushion(distance, width)); };
  cut(limb(p, {0, -1}, {0, 3.2}, 0.16, 0.12), 0.16);
  cut(std::max(box(p, {0, 1.3}, {1.7 - 0.15 * p.y, 0.95}), -limb(p, {0, -1}, {0, 3.2}, 0.28, 0.24)), 0.4);
  cut(limb(p, {-3.2, -1}, {-3.9, 0.3}, 0.22, 0.1), 0.2);
  cut(limb(p, {3.2, -1}, {3.9, -0.2}, 0.22, 0.1), 0.2);
  for (int oar = -3; oar <= 3; ++oar) cut(limb(p, {0.75 * oar, -1.5}, {0.75 * oar - 0.7, -2.9}, 0.1, 0.13), 0.12);
  for (double const side : {-3.0, 3.0}) cut(disc(p, {side, 2}, 0.35), 0.3);
  return depth;
}

Finish finish(Uv const& uv, std::uint32_t seed) {
  V3d const p = place(uv, seed);
  double const top = bezel(uv.v), grain = fractal(p * 1.5, 4, seed + 1),
               outer = step(0.15, 0.5, std::cos(2 * kPi * uv.u));
  bool const face = top > 0.9 && p.y > kFinger + 1.8;
  double const strand = uv.v * 40,
               braid = std::max(std::sin(2 * kPi * (strand + 0.22 * p.z)), std::sin(2 * kPi * (strand - 0.22 * p.z)));
  double const rim = cushion(std::abs(std::abs(p.z) - 1.75) - 0.22, 0.22);
  double const carved = face ? -0.75 * device(V2d(p.x, -p.z) / 1.5) : outer * (1 - top) * (0.22 * braid + 0.25 * rim);
  return {carved + 0.025 * grain - 0.08 * step(0.4, 0.5, fractal(p * 0.8, 4, seed + 2)), V3d(0.85, 0.65, 0.28)};
}

}  // namespace

std::vector<Part> ring(std::uint32_t seed) {
  return {{Topology::torus, [=](Uv const& uv) { return lean(place(uv, seed)); },
           [=](Uv const& uv, V3d const&) { return finish(uv, seed); }}};
}

}  // namespace vitrine::sample
