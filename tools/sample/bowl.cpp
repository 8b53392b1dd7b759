// SPDX-License-Identifier: Apache-2.0
#include "tools/sample/draw.h"
#include "tools/sample/objects.h"

namespace vitrine::sample {
namespace {

constexpr V3d kWhite(0.93, 0.92, 0.87), kCobalt(0.10, 0.17, 0.46), kTurquoise(0.13, 0.55, 0.58), kRed(0.72, 0.17, 0.11);

/// Radius and height from the middle of the floor to the rim; one sheet, as thin ware is often scanned.
Curve profile() {
  return Curve({{0, 0, 0}, {22, 0, 0}, {34, 1, 0}, {48, 6, 0}, {78, 24, 0}, {98, 46, 0}, {108, 66, 0}, {117, 76, 0}});
}

/// One motif of the band: a stem with a tulip or a daisy and two leaves; x in -0.5..0.5, y in 0..1.
V3d flower(V2d p, bool tulip) {
  double const stem = limb(p, {0.1, 0}, {0, 0.55}, 0.02, 0.016);
  double const leaves =
      std::min(limb(p, {0.06, 0.1}, {-0.24, 0.5}, 0.05, 0.01), limb(p, {0.06, 0.12}, {0.3, 0.44}, 0.05, 0.01));
  V3d colour = mix(kWhite, kTurquoise, ink(std::min(stem, leaves), 0.012));
  if (tulip) {
    double const cup = std::max(ellipse(p, {0, 0.74}, {0.15, 0.2}), -limb(p, {0, 1.1}, {0, 0.8}, 0.09, 0.01));
    colour = mix(colour, kCobalt, ink(cup - 0.022, 0.012));
    return mix(colour, kRed, ink(cup, 0.012));
  }
  V2d const q = p - V2d(0, 0.74);
  double const petals = q.length() - 0.15 - 0.045 * std::cos(6 * std::atan2(q.y, q.x));
  colour = mix(colour, kCobalt, ink(petals, 0.012));
  return mix(colour, kRed, ink(q.length() - 0.06, 0.012));
}

V3d rosette(double v, double angle) {
  double const outer = v - 0.25 * (0.74 + 0.26 * std::cos(8 * angle)),
               inner = v - 0.15 * (0.7 + 0.3 * std::cos(8 * angle + kPi));
  V3d colour = mix(kWhite, kCobalt, ink(outer, 0.003));
  colour = mix(colour, kTurquoise, ink(inner + 0.01, 0.003));
  colour = mix(colour, kWhite, ink(std::abs(inner + 0.01) - 0.004, 0.002));
  return mix(colour, kRed, ink(v - 0.045, 0.003));
}

V3d paint(double u, double v) {
  double const angle = 2 * kPi * u, cell = u * 16;
  auto const ring = [&](double at, double half) { return ink(std::abs(v - at) - half, 0.002); };
  V3d colour = kWhite;
  if (v < 0.3) colour = rosette(v, angle);
  if (v > 0.36 && v < 0.8)
    colour = flower({cell - std::floor(cell) - 0.5, (v - 0.37) / 0.42}, int(std::floor(cell)) % 2 == 0);
  double const wave = v - 0.905 - 0.025 * std::sin(36 * angle);
  if (v > 0.84) colour = mix(colour, kCobalt, ink(std::abs(wave) - 0.012, 0.003));
  for (double const at : {0.315, 0.345, 0.825, 0.845}) colour = mix(colour, kCobalt, ring(at, 0.0035));
  return mix(colour, kCobalt, step(0.975, 0.98, v));
}

V3d place(Uv const& uv, std::uint32_t seed) {
  double const angle = 2 * kPi * uv.u, chip = std::exp(-std::pow(std::remainder(angle - 1.1, 2 * kPi) / 0.16, 2));
  double const rim = 1 - chip * (0.11 + 0.03 * noise({angle * 22, 0.5, 0.5}, seed + 1)) * step(0.5, 1, uv.v);
  static Curve const curve = profile();
  V3d const p = curve.at(uv.v * rim);
  double const scallop = 1 + 0.02 * step(0.6, 1, uv.v) * std::cos(18 * angle);
  V3d const q(-p.x * scallop * std::sin(angle), p.y, p.x * scallop * std::cos(angle));
  double const lean = 0.95;  // shown on a stand, its inside to the front
  return {q.x, q.y * std::cos(lean) - q.z * std::sin(lean), q.y * std::sin(lean) + q.z * std::cos(lean)};
}

/// Broken once and mended with gold, along the borders of large cells.
Finish finish(Uv const& uv, V3d const& p, std::uint32_t seed) {
  V3d const bent =
      p * 0.011 +
      V3d(fractal(p * 0.03, 4, seed), fractal(p * 0.03, 4, seed + 1), fractal(p * 0.03, 4, seed + 2)) * 0.16;
  Cell const shard = cells(bent, seed + 5);
  double const seam = step(0.015, 0.008, shard.second - shard.nearest), grain = fractal(p * 0.3, 4, seed + 3);
  V3d const glaze = paint(uv.u, uv.v) * (1 + 0.035 * grain + 0.06 * fractal(p * 0.015, 3, seed + 4));
  double const speck = step(0.5, 0.56, fractal(p * 0.5, 3, seed + 6));
  V3d const worn = mix(glaze, V3d(0.5, 0.4, 0.3), 0.6 * speck);
  return {0.05 * grain + 0.5 * seam - 0.1 * speck, mix(worn, V3d(0.85, 0.64, 0.22) * (1 + 0.12 * grain), seam)};
}

}  // namespace

std::vector<Part> bowl(std::uint32_t seed) {
  return {{Topology::cap, [=](Uv const& uv) { return place(uv, seed); },
           [=](Uv const& uv, V3d const& p) { return finish(uv, p, seed); }}};
}

}  // namespace vitrine::sample
