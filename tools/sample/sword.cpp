// SPDX-License-Identifier: Apache-2.0
#include "tools/sample/draw.h"
#include "tools/sample/objects.h"

namespace vitrine::sample {
namespace {

/// Half width, half thickness and height from the tip down to the pommel.
Curve outline() {
  return Curve({{0, 0, 620},      {5, 1.6, 606}, {13, 2.6, 560}, {20, 3.1, 490}, {21.5, 3.4, 420}, {18, 3.6, 320},
                {15.5, 3.8, 230}, {17, 4, 180},  {24, 4.2, 158}, {30, 5, 146},   {29, 7, 138},     {17, 7.5, 126},
                {11, 7, 112},     {12, 7.5, 78}, {14, 8, 52},    {11, 7, 22},    {15, 8, 12},      {24, 9, 4},
                {25, 9, -4},      {17, 7, -11},  {0, 0, -13}});
}

bool blade(double y) { return y > 150; }

V3d place(Uv const& uv, std::uint32_t seed) {
  static Curve const curve = outline();
  V3d const at = curve.at(uv.v);
  double const angle = 2 * kPi * uv.u, s = std::sin(angle), c = std::cos(angle);
  double const edge = blade(at.z) ? 1 : 0, lens = mix(std::copysign(1.0, c) * std::abs(c), c * std::abs(c), 0.8 * edge);
  double const nick =
      edge * step(0.9, 1, std::abs(s)) * std::max(0.0, fractal({0, at.z * 0.05, s}, 4, seed + 1) - 0.15) * 5;
  double const bow =
      3.5 * std::sin(at.z / 620 * kPi) + 2 * noise({0, at.z * 0.004, 0.5}, seed + 2);  // bent in the ground
  return {std::copysign(std::max(0.0, at.x * std::abs(s) - nick), s), at.z, at.y * lens + bow};
}

Finish finish(Uv const& uv, V3d const& p, std::uint32_t seed) {
  double const across = std::sin(2 * kPi * uv.u), grain = fractal(p * 0.3, 5, seed + 3);
  double rise = 0;
  if (blade(p.y)) {
    double const end = step(598, 570, p.y) * step(150, 166, p.y);
    rise += end * (1.3 * std::exp(-std::pow(across / 0.16, 2)) -
                   0.35 * std::exp(-std::pow((std::abs(across) - 0.42) / 0.035, 2)));
    rise -= 0.3 * end * std::exp(-std::pow((std::abs(across) - 0.54) / 0.03, 2));
  } else {
    rise += 0.5 * std::sin(p.y * 1.15) * step(22, 28, p.y) * step(112, 106, p.y);
    for (double const y : {137.0, 147.0})
      for (double const x : {-18.0, 0.0, 18.0}) rise += 1.4 * cushion(disc({p.x, p.y}, {x, y - 5}, 3), 2.5);
  }
  double const crust = step(0.05, 0.5, fractal(p * 0.05, 5, seed + 4)),
               bare = step(0.2, 0.5, fractal(p * 0.03 + V3d(9), 4, seed + 5));
  V3d const verdigris = mix(V3d(0.33, 0.47, 0.39), V3d(0.49, 0.63, 0.54), step(-0.4, 0.5, grain));
  V3d colour = mix(V3d(0.33, 0.29, 0.20), verdigris, step(-0.35, 0.25, fractal(p * 0.022, 5, seed + 6) + 0.25 * grain));
  colour = mix(colour, V3d(0.66, 0.49, 0.25), 0.75 * bare * (1 - crust));
  return {rise + 0.3 * crust * (0.6 + grain) + 0.08 * grain - 0.4 * step(0.42, 0.5, fractal(p * 0.2, 4, seed + 7)),
          mix(colour, V3d(0.55, 0.66, 0.56), 0.4 * crust) * (1 + 0.12 * grain)};
}

}  // namespace

std::vector<Part> sword(std::uint32_t seed) {
  return {{Topology::ball, [=](Uv const& uv) { return place(uv, seed); },
           [=](Uv const& uv, V3d const& p) { return finish(uv, p, seed); }}};
}

}  // namespace vitrine::sample
