// SPDX-License-Identifier: Apache-2.0
#include "tools/sample/draw.h"
#include "tools/sample/objects.h"

namespace vitrine::sample {
namespace {

constexpr int kFlutes = 20;
constexpr double kNeck = 498;

/// Radius and height from the middle of the top to the break: slab, cushion, rings, shaft.
Curve profile() {
  return Curve({{0, 600, 0},   {118, 600, 0}, {118, 600, 0}, {119, 598, 0}, {119, 562, 0},  {118, 560, 0},
                {118, 560, 0}, {110, 556, 0}, {104, 545, 0}, {90, 526, 0},  {79, 514, 0},   {79, 511, 0},
                {81, 509, 0},  {78, 507, 0},  {80, 505, 0},  {77, 502, 0},  {76, kNeck, 0}, {78, 400, 0},
                {82, 250, 0},  {87, 60, 0},   {88, 14, 0},   {84, 4, 0},    {70, 0, 0},     {0, 0, 0}});
}

double flute(double turns, double y, V3d const& p, std::uint32_t seed) {
  double const x = turns * kFlutes, across = 2 * (x - std::floor(x) - 0.5);
  double const hollow = std::sqrt(1 - 0.98 * across * across), ends = step(kNeck, kNeck - 16, y + 12 * across * across);
  double const blunt = 1.6 * step(0.75, 1, std::abs(across)) * step(0, 0.4, fractal(p * 0.03, 4, seed + 1));
  return -ends * (6.5 * hollow + blunt);
}

V3d place(Uv const& uv, std::uint32_t seed) {
  static Curve const curve = profile();
  V3d const p = curve.at(uv.v);
  double const angle = 2 * kPi * uv.u, c = std::abs(std::cos(angle)), s = std::abs(std::sin(angle));
  double const square = std::pow(std::pow(c, 14) + std::pow(s, 14), -1.0 / 14);
  double const radius = p.x * mix(1, square, step(556, 561, p.y));
  V3d q(radius * std::sin(angle), p.y, radius * std::cos(angle));
  double const loss = step(0.38, 0.46, fractal(q * 0.013, 4, seed + 4));
  double const shaft = step(kNeck + 2, kNeck - 2, p.y) * step(0, 20, p.y);
  q += V3d(std::sin(angle), 0, std::cos(angle)) * (shaft * (flute(uv.u, p.y, q, seed) - 4 * loss));
  // The lower end is a fracture.
  double const broken = 42 + 0.22 * q.x - 0.14 * q.z + 9 * fractal(q * 0.016, 4, seed + 9);
  q.y = std::max(q.y, broken + 3 * fractal(V3d(q.x, 0, q.z) * 0.06, 4, seed + 10));
  return q;
}

Finish finish(V3d const& p, std::uint32_t seed) {
  double const grain = fractal(p * 0.12, 5, seed + 2), pits = step(0.34, 0.5, fractal(p * 0.09, 5, seed + 3));
  return {0.35 * grain - 0.7 * pits, V3d(0.8, 0.77, 0.7) * (1 + 0.08 * grain)};
}

}  // namespace

std::vector<Part> column(std::uint32_t seed) {
  return {{Topology::ball, [=](Uv const& uv) { return place(uv, seed); },
           [=](Uv const&, V3d const& p) { return finish(p, seed); }}};
}

}  // namespace vitrine::sample
