// SPDX-License-Identifier: Apache-2.0
#include "tools/sample/draw.h"
#include "tools/sample/objects.h"

namespace vitrine::sample {
namespace {

constexpr int kBeads = 56;

/// The string, as it lies on a table: v once round from the clasp.
V3d string_at(double v) {
  double const t = 2 * kPi * v;
  return {68 * std::sin(t) * (1 - 0.12 * std::cos(t)), 82 * std::cos(t), 3.5 * std::sin(3 * t) + 2 * std::cos(5 * t)};
}

V3d along(double v) { return (string_at(v + 1e-4) - string_at(v - 1e-4)).normalized(); }

/// A point around the axis `axis` at angle 2 pi u.
V3d around(V3d const& axis, double u) {
  V3d const side = axis.cross(V3d(0, 0, 1)).normalized(), up = side.cross(axis);
  return side * std::cos(2 * kPi * u) + up * std::sin(2 * kPi * u);
}

struct Stone {
  double radius, half_length;
  V3d light, dark;
};
constexpr Stone kStones[] = {
    {3.1, 2.2, {0.90, 0.72, 0.32}, {0.62, 0.43, 0.14}},  // gold
    {4.6, 4.6, {0.72, 0.25, 0.11}, {0.42, 0.10, 0.05}},  // carnelian
    {4.0, 3.6, {0.16, 0.27, 0.62}, {0.06, 0.10, 0.30}},  // lapis
    {4.3, 3.0, {0.33, 0.70, 0.68}, {0.16, 0.45, 0.46}},  // turquoise
};

Stone const& stone_of(int bead) { return kStones[bead % 2 == 0 ? 0 : 1 + bead / 2 % 3]; }

Finish polish(V3d const& p, Stone const& stone, std::uint32_t seed) {
  double const cloud = fractal(p * 0.18, 5, seed), grain = fractal(p * 1.2, 4, seed + 1);
  double const fleck = step(0.45, 0.5, fractal(p * 0.7, 3, seed + 2)),
               dirt = step(0.25, 0.6, fractal(p * 0.3, 4, seed + 3));
  V3d const colour = mix(mix(stone.dark, stone.light, step(-0.5, 0.5, cloud)), V3d(0.85, 0.75, 0.5), 0.5 * fleck);
  return {0.03 * grain + 0.05 * cloud - 0.08 * dirt,
          mix(colour * (1 + 0.06 * grain), V3d(0.35, 0.27, 0.2), 0.45 * dirt)};
}

/// A pierced-looking barrel on the string; gold ones are ribbed.
Part bead(int index, std::uint32_t seed) {
  Stone const& stone = stone_of(index);
  double const at = (index + 0.5) / kBeads,
               size = 1.0 + 0.35 * std::pow(std::sin(kPi * at), 2) + 0.12 * (random(index, 5, 0, seed) - 0.5);
  auto const place = [=](Uv const& uv) {
    V3d const axis = along(at);
    double const polar = kPi * uv.v, fold = std::sin(polar),
                 rib = stone.radius < 3.5 ? 1 + 0.07 * std::cos(16 * kPi * uv.u) : 1;
    double const radius = stone.radius * size * std::pow(fold, 0.7) * rib;
    return string_at(at) - axis * (stone.half_length * size * std::cos(polar)) + around(axis, uv.u) * radius;
  };
  return {Topology::ball, place, [=](Uv const&, V3d const& p) { return polish(p, stone, seed + unsigned(index)); }};
}

/// A drop of lapis in a gold cap, opposite the clasp.
Part pendant(std::uint32_t seed) {
  Curve const curve({{0, 5, 0},
                     {3.5, 4.5, 0},
                     {4.5, 2, 0},
                     {4.5, 0, 0},
                     {6, -1, 0},
                     {6, -1, 0},
                     {9.5, -12, 0},
                     {9, -20, 0},
                     {5, -26, 0},
                     {0, -28, 0}});
  auto const place = [=](Uv const& uv) {
    return turn(curve, uv.u, uv.v) * V3d(1, 1, 0.7) + string_at(0.5) + V3d(0, -7, 0);
  };
  auto const finish = [=](Uv const& uv, V3d const& p) {
    return polish(p, uv.v < 0.3 ? kStones[0] : kStones[2], seed + 900);
  };
  return {Topology::ball, place, finish};
}

Part thread(std::uint32_t seed) {
  auto const place = [](Uv const& uv) { return string_at(uv.v) + around(along(uv.v), uv.u) * 0.7; };
  auto const finish = [=](Uv const& uv, V3d const& p) {
    double const twist = std::sin(2 * kPi * (2 * uv.u + 300 * uv.v));
    return Finish{0.08 * twist, V3d(0.55, 0.42, 0.27) * (1 + 0.15 * twist + 0.1 * fractal(p, 3, seed))};
  };
  return {Topology::torus, place, finish};
}

}  // namespace

std::vector<Part> necklace(std::uint32_t seed) {
  std::vector<Part> parts{thread(seed), pendant(seed)};
  for (int i = 0; i < kBeads; ++i) parts.push_back(bead(i, seed));
  return parts;
}

}  // namespace vitrine::sample
