// SPDX-License-Identifier: Apache-2.0
#include "tools/sample/draw.h"
#include "tools/sample/objects.h"

namespace vitrine::sample {
namespace {

constexpr double kPot = 120, kHalfThickness = 3.2;  // radius of the pot that it comes from
constexpr V3d kClay(0.80, 0.45, 0.24), kGlaze(0.09, 0.075, 0.07);

/// Distance from the middle to the break: straight fractures with ragged lines.
double outline(double angle, std::uint32_t seed) {
  double reach = 70;
  for (std::uint32_t i = 0; i < 6; ++i) {
    double const way = 2 * kPi * (i + 0.7 * random(i, 1, 0, seed)) / 6, off = std::cos(angle - way);
    if (off > 0.1) reach = std::min(reach, (36 + 16 * random(i, 2, 0, seed)) / off);
  }
  return reach + 1.2 * fractal({8 * std::cos(angle), 8 * std::sin(angle), 0.5}, 4, seed + 1);
}

/// Flat coordinates of a place on the pot's wall, in mm along the surface.
V2d unrolled(V3d const& p) { return {std::atan2(p.x, p.z + kPot) * kPot, p.y}; }

V3d place(Uv const& uv, std::uint32_t seed) {
  V2d const q = square_to_disc(uv.u, uv.v);
  double const s = q.length(), bend = 0.86, side = uv.back ? -1 : 1;
  double const turn = std::clamp((s - bend) / (1 - bend), 0.0, 1.0), reach = outline(std::atan2(q.y, q.x), seed);
  V2d const flat = s < 1e-9 ? V2d(0, 0) : q / s * reach * (std::min(s / bend, 1.0) * 0.985 + 0.015 * turn);
  double const depth = side * kHalfThickness * (1 - turn), around = flat.x / kPot, wall = kPot + depth;
  V3d p(wall * std::sin(around), flat.y, wall * std::cos(around) - kPot);
  double const raw = turn > 0 ? step(0, 0.3, turn) : 0;
  return p + V3d(q.x, q.y, 0) * (raw * 1.6 * fractal(p * 0.25, 4, seed + 2));
}

double glaze(V2d p) {
  double const y = p.y + 34;
  if (y < 2) return 1;
  if (y < 12) return meander(p.x / 12, (y - 2) / 10) ? 1 : 0;
  if (y < 14) return 1;
  Figure const left = warrior({(p.x + 16) / 58, (y - 14) / 58}), right = horse({(p.x - 24) / 58, (y - 14) / 58});
  double const body = std::min(left.body, right.body), incised = std::min(left.incised, right.incised);
  return ink(body, 0.006) * (1 - ink(incised, 0.003));
}

Finish finish(Uv const& uv, V3d const& p, std::uint32_t seed) {
  V2d const q = square_to_disc(uv.u, uv.v);
  double const raw = step(0.865, 0.89, q.length()), grain = fractal(p * 0.4, 5, seed + 3),
               cloud = fractal(p * 0.04, 4, seed + 4);
  double const flake = step(0.4, 0.47, fractal(p * 0.09, 5, seed + 5));
  double const cover = uv.back ? 0 : glaze(unrolled(p)) * (1 - flake) * (1 - raw);
  V3d const clay = kClay * (uv.back ? 0.92 : 1) * (1 + 0.12 * cloud + 0.08 * grain),
            core = V3d(0.58, 0.40, 0.30) * (1 + 0.25 * grain);
  double const soil = 0.6 * step(0.1, 0.7, fractal(p * 0.07, 5, seed + 6));
  double const wheel = uv.back ? 0.18 * std::sin(p.y * 1.3 + noise(p * 0.05, seed + 7)) : 0;
  return {wheel + 0.1 * grain - 0.3 * flake * (1 - raw) + 0.35 * raw * fractal(p * 0.9, 3, seed + 8),
          mix(mix(mix(clay, kGlaze, cover), core, raw), V3d(0.52, 0.42, 0.31), soil)};
}

/// What a scanner leaves in the air about an object: torn scraps and specks.
Part floater(std::uint32_t index, std::uint32_t seed) {
  auto const draw = [=](std::uint32_t k) { return 2 * random(index, k, 77, seed) - 1; };
  V3d const centre = V3d(draw(1), draw(2), 0.7 * draw(3)).normalized() * (62 + 12 * draw(4));
  double const size = 1.3 + 0.9 * draw(5);
  bool const scrap = index % 2 == 0;
  auto const place = [=](Uv const& uv) {
    double const polar = kPi * uv.v, angle = 2 * kPi * uv.u;
    V3d const ball(std::sin(polar) * std::sin(angle), std::cos(polar), std::sin(polar) * std::cos(angle));
    V3d const sheet(2.6 * uv.u - 1.3, 1.3 - 2.6 * uv.v, 0.6 * noise({3 * uv.u, 3 * uv.v, 0.5}, seed + index));
    V3d const p = scrap ? sheet : ball;
    return centre + p * size * (1 + 0.4 * noise(p * 1.3 + centre, seed + index));
  };
  V3d const colour = V3d(0.55, 0.48, 0.42) * (1 + 0.3 * draw(6));
  return {scrap ? Topology::sheet : Topology::ball, place, [=](Uv const&, V3d const&) { return Finish{0, colour}; }};
}

}  // namespace

std::vector<Part> sherd(std::uint32_t seed) {
  std::vector<Part> parts{{Topology::pillow, [=](Uv const& uv) { return place(uv, seed); },
                           [=](Uv const& uv, V3d const& p) { return finish(uv, p, seed); }}};
  for (std::uint32_t i = 0; i < 12; ++i) parts.push_back(floater(i, seed));
  return parts;
}

}  // namespace vitrine::sample
