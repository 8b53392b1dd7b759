// SPDX-License-Identifier: Apache-2.0
#include "tools/sample/draw.h"
#include "tools/sample/objects.h"

namespace vitrine::sample {
namespace {

constexpr double kHalf = 165, kStone = 5.2;  // half of the panel's side and a stone's side, in mm
constexpr V3d kCream(0.86, 0.80, 0.67), kBlack(0.16, 0.15, 0.16), kBlue(0.24, 0.38, 0.52), kTeal(0.36, 0.55, 0.56),
    kBrick(0.62, 0.25, 0.17), kOchre(0.80, 0.60, 0.28), kGrey(0.55, 0.56, 0.56);

V3d dolphin(V2d p) {
  double const back = std::min({limb(p, {-66, -8}, {-46, 12}, 7, 13), limb(p, {-46, 12}, {-8, 26}, 13, 21),
                                limb(p, {-8, 26}, {34, 18}, 21, 13), limb(p, {34, 18}, {62, -18}, 13, 4)});
  double const snout = limb(p, {-62, -6}, {-84, -16}, 5, 3);
  double const fins = std::min({limb(p, {62, -18}, {82, -14}, 4, 2), limb(p, {62, -18}, {64, -42}, 4, 2),
                                limb(p, {4, 44}, {26, 58}, 7, 1.5), limb(p, {-22, 8}, {-30, -18}, 7, 2)});
  double const belly = limb(p, {-56, -6}, {30, 4}, 4, 4);
  if (disc(p, {-54, 8}, 3.2) < 0) return kCream;
  if (fins < 0) return kBrick;
  if (std::min(back, snout) < 0) return belly < 0 || snout < -1 ? kGrey : std::min(back, snout) < -7 ? kBlue : kBlack;
  double const wave = p.y + 46 + 5 * std::sin(p.x * 0.13), far = p.y + 66 + 5 * std::sin(p.x * 0.13 + 2);
  if (std::abs(wave) < 2.8 || std::abs(far) < 2.8) return kTeal;
  return far < -8 && std::abs(p.y + 84 + 3 * std::sin(p.x * 0.13)) < 2.8 ? kTeal : kCream;
}

/// Two strands plaited around the medallion.
V3d plait(double radius, double angle) {
  double const x = angle * 12, middle = (radius - 120) / 10;
  for (double const phase : {0.0, kPi}) {
    double const d = std::abs(middle - 0.75 * std::sin(x + phase)), front = std::cos(x + phase);
    if (d < 0.62 && (front > 0 || std::abs(middle + 0.75 * std::sin(x + phase)) > 0.62))
      return d > 0.42 ? kBlack : phase > 0 ? (d < 0.18 ? kCream : kBrick) : (d < 0.18 ? kCream : kOchre);
  }
  return kBlack;
}

/// The picture, before it is cut into stones.
V3d picture(V2d p) {
  double const radius = p.length(), edge = std::max(std::abs(p.x), std::abs(p.y));
  if (radius < 100) return dolphin(p);
  if (radius < 106 || (radius > 134 && radius < 140)) return kBlack;
  if (radius < 134) return plait(radius, std::atan2(p.y, p.x));
  if (edge > 158) return kBrick;
  if (edge > 152) return kCream;
  V2d const corner(std::abs(p.x) - 132, std::abs(p.y) - 132);
  double const petals = corner.length() - 15 - 5 * std::cos(4 * std::atan2(corner.y, corner.x));
  return petals < 0 ? (corner.length() < 6 ? kOchre : kBrick) : petals < 6 ? kBlack : kCream;
}

/// The stone that covers a place: its middle, and how far the place is from its joint (negative: in the joint).
struct Stone {
  V2d middle;
  double inside;
  std::uint32_t id;
};

Stone laid(V2d p, std::uint32_t seed) {
  auto const cell = [&](double x, std::uint32_t line) {  // along a row, joints shaken
    double const at = std::floor(x);
    auto const joint = [&](double i) { return i + 0.3 * (random(std::uint32_t(int(i) + 4096), line, 0, seed) - 0.5); };
    double const first = x < joint(at) ? at - 1 : x > joint(at + 1) ? at + 1 : at;
    return std::array<double, 3>{joint(first), joint(first + 1), first};
  };
  bool const round = p.length() < 140;  // stones follow the circles, and the straight border
  double const row = std::floor((round ? p.length() : p.y) / kStone), across = row + 0.5;
  double const scale = round ? std::max(3.0, std::round(2 * kPi * across)) / (2 * kPi) : 1 / kStone;
  double const x = (round ? std::atan2(p.y, p.x) + kPi : p.x + 200) * scale,
               y = (round ? p.length() : p.y) / kStone - row;
  auto const line = std::uint32_t(int(row) + (round ? 9000 : 500));
  auto const [from, to, index] = cell(x, line);
  double const middle = (from + to) / 2 / scale, reach = round ? across * kStone : 1;
  V2d const centre =
      round ? V2d(std::cos(middle - kPi), std::sin(middle - kPi)) * reach : V2d(middle - 200, across * kStone);
  double const gap = 0.45, along = std::min(x - from, to - x) * kStone;
  return {centre, std::min(along, std::min(y, 1 - y) * kStone) - gap,
          hash(line, std::uint32_t(int(index) + 4096), 1, seed)};
}

V3d place(Uv const& uv, std::uint32_t seed) {
  double const a = 2 * uv.u - 1, b = 1 - 2 * uv.v;
  auto const ragged = [&](double t, double side) {
    return 1 - 0.05 * (1 + noise({t * 2.2, side, 0.5}, seed + 1) + 0.5 * noise({t * 9, side, 0.5}, seed + 2));
  };
  V3d p(a * kHalf * ragged(b, a > 0 ? 3.3 : 7.7), b * kHalf * ragged(a, b > 0 ? 11.1 : 15.2), 0);
  p.z = 3 * fractal(p * 0.006, 3, seed + 3);  // the floor has settled
  return p;
}

Finish finish(V3d const& p, std::uint32_t seed) {
  Stone const stone = laid({p.x, p.y}, seed);
  double const grain = fractal(p * 0.3, 4, seed + 4), fine = fractal(p * 1.1, 3, seed + 5);
  bool const lost = stone.id % 70 == 0 || fractal(V3d(stone.middle.x, stone.middle.y, 0) * 0.012, 4, seed + 6) > 0.43;
  double const body = lost ? 0 : step(-0.2, 0.5, stone.inside);
  V2d const off = V2d(p.x, p.y) - stone.middle;
  double const tilt = off.x * (random(stone.id, 1) - 0.5) * 0.12 + off.y * (random(stone.id, 2) - 0.5) * 0.12 +
                      0.5 * (random(stone.id, 3) - 0.5);
  V3d const mortar = V3d(0.60, 0.54, 0.45) * (1 + 0.15 * grain);
  V3d const colour = picture(stone.middle) * (0.84 + 0.3 * random(stone.id, 4) + 0.06 * fine);
  double const dust = 0.3 * step(0, 0.6, fractal(p * 0.02, 4, seed + 7));
  return {body * (1.5 + tilt) + 0.15 * grain - (lost ? 0.6 : 0), mix(mix(mortar * 0.8, colour, body), mortar, dust)};
}

}  // namespace

std::vector<Part> mosaic(std::uint32_t seed) {
  return {{Topology::sheet, [=](Uv const& uv) { return place(uv, seed); },
           [=](Uv const&, V3d const& p) { return finish(p, seed); }}};
}

}  // namespace vitrine::sample
