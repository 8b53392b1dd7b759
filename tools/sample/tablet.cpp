// SPDX-License-Identifier: Apache-2.0
#include "tools/sample/draw.h"
#include "tools/sample/objects.h"

namespace vitrine::sample {
namespace {

constexpr double kHalfWidth = 36, kHalfHeight = 46, kHalfThickness = 11;
constexpr double kLine = 7.4, kSign = 6.2;  // pitch of the script

/// Depth of one stylus mark, 0..1: a triangular head at the origin and a tail along +x.
double wedge(V2d p, double length) {
  double const t = p.x / length;
  if (t < 0 || t > 1) return 0;
  double const half = 1.25 * std::pow(1 - t, 3) + 0.28 * (1 - t);
  return (0.35 + 0.65 * (1 - t)) * std::max(0.0, 1 - std::abs(p.y) / half);
}

/// Depth at a place within the sign `id`: two to five marks, lying, standing or slanted.
double sign(V2d p, std::uint32_t id) {
  double depth = 0;
  std::uint32_t const marks = 2 + hash(id, 1) % 4;
  for (std::uint32_t i = 0; i < marks; ++i) {
    double const angle = (hash(id, i, 2) % 5 < 2   ? 0
                          : hash(id, i, 2) % 5 < 4 ? -kPi / 2
                                                   : -kPi / 4) +
                         0.15 * (random(id, i, 3) - 0.5);
    V2d const at(-2.6 + 3.6 * random(id, i, 4), -1.6 + 3.8 * random(id, i, 5)), q = p - at;
    V2d const own(q.x * std::cos(angle) + q.y * std::sin(angle), q.y * std::cos(angle) - q.x * std::sin(angle));
    depth = std::max(depth, wedge(own, 2.4 + 2.2 * random(id, i, 6)));
  }
  return depth;
}

double script(V2d p, std::uint32_t seed) {
  if (std::abs(p.x) > kHalfWidth - 4.5 || std::abs(p.y) > kHalfHeight - 5) return 0;
  double const line = std::floor(p.y / kLine), shift = kSign * random(std::uint32_t(int(line) + 99), 7, 0, seed);
  double depth = 0;
  for (int neighbour = -1; neighbour <= 1; ++neighbour) {
    double const column = std::floor((p.x + shift) / kSign) + neighbour;
    std::uint32_t const id = hash(std::uint32_t(int(line) + 99), std::uint32_t(int(column) + 99), 0, seed);
    if (id % 9 == 0) continue;  // a word ends
    depth = std::max(depth, sign({p.x + shift - (column + 0.5) * kSign, p.y - (line + 0.5) * kLine}, id));
  }
  double const ruled = std::abs(p.y - kLine * std::round(p.y / kLine));
  return std::max(depth, 0.3 * step(0.35, 0.1, ruled));
}

/// A cushion with rolled edges; one corner and a flake of the edge are broken off.
V3d place(Uv const& uv, std::uint32_t seed) {
  double const a = 2 * uv.u - 1, b = 1 - 2 * uv.v, s = std::max(std::abs(a), std::abs(b)), side = uv.back ? -1 : 1;
  V2d const d = s < 1e-9 ? V2d(0, 0) : V2d(a, b) / s;
  double const corner = s < 1e-9 ? 1 : std::pow(std::pow(std::abs(d.x), 7) + std::pow(std::abs(d.y), 7), -1.0 / 7);
  double const bend = 0.8, turn = std::clamp((s - bend) / (1 - bend), 0.0, 1.0) * kPi / 2;
  double const reach = (0.84 * std::min(s / bend, 1.0) + 0.16 * std::sin(turn)) * mix(1, corner, step(0.2, 1, s));
  V3d p(d.x * reach * kHalfWidth, d.y * reach * kHalfHeight,
        side * (kHalfThickness * std::cos(turn) + 2.5 * (1 - s * s)));
  for (V3d const& way : {V3d(0.7, 0.65, 0.3), V3d(-0.9, -0.35, 0.25)}) {
    V3d const out = way.normalized();
    double const rough = 1.3 * fractal(p * 0.09, 4, seed + 31) + 0.5 * fractal(p * 0.4, 3, seed + 32);
    double const over = p.dot(out) - (way.x > 0 ? 47.5 : 41) - rough;
    if (over > 0) p -= out * over;
  }
  return p;
}

Finish finish(Uv const& uv, V3d const& p, std::uint32_t seed) {
  double const broken = step(43.5, 45, p.dot(V3d(0.7, 0.65, 0.3).normalized())) +
                        step(38.2, 39.5, p.dot(V3d(-0.9, -0.35, 0.25).normalized()));
  double const face = step(0.35, 0.7, std::abs(p.z) / kHalfThickness) * (1 - std::min(broken, 1.0));
  double const depth = face * script({uv.back ? -p.x : p.x, p.y}, seed + uv.back);
  double const grain = fractal(p * 0.35, 5, seed + 2), cloud = fractal(p * 0.03, 4, seed + 3);
  V3d const bent = p * 0.022 + V3d(1, 1, 1) * (0.12 * fractal(p * 0.08, 4, seed + 4));
  Cell const piece = cells(bent, seed + 6);
  double const crack = step(0.02, 0.005, piece.second - piece.nearest) * step(-0.1, 0.2, noise(p * 0.02, seed + 7));
  V3d colour = mix(V3d(0.62, 0.47, 0.33), V3d(0.78, 0.65, 0.48), step(-0.5, 0.5, cloud + 0.4 * grain));
  colour = mix(colour, V3d(0.36, 0.29, 0.24), 0.7 * step(0.15, 0.6, fractal(p * 0.02, 4, seed + 9)));  // soot
  colour = mix(colour, V3d(0.72, 0.52, 0.38), 0.6 * std::min(broken, 1.0));
  return {-1.25 * depth - 0.5 * crack + 0.12 * grain + 0.25 * cloud,
          colour * (1 - 0.45 * depth) * (1 - 0.5 * crack) * (1 + 0.08 * grain)};
}

}  // namespace

std::vector<Part> tablet(std::uint32_t seed) {
  return {{Topology::pillow, [=](Uv const& uv) { return place(uv, seed); },
           [=](Uv const& uv, V3d const& p) { return finish(uv, p, seed); }}};
}

}  // namespace vitrine::sample
