// SPDX-License-Identifier: Apache-2.0
#include "tools/sample/draw.h"
#include "tools/sample/objects.h"

namespace vitrine::sample {
namespace {

constexpr V3d kClay(0.78, 0.43, 0.22), kGlaze(0.085, 0.07, 0.065), kEarth(0.55, 0.44, 0.32);

/// From the floor inside the neck over the lip and down to the foot: radius and height.
Curve profile() {
  return Curve({{0, 352, 0},  {28, 354, 0},  {36, 366, 0},  {38, 392, 0},  {50, 420, 0},  {63, 440, 0}, {71, 446, 0},
                {77, 442, 0}, {77, 430, 0},  {68, 422, 0},  {53, 412, 0},  {45, 392, 0},  {44, 372, 0}, {49, 352, 0},
                {66, 335, 0}, {106, 314, 0}, {137, 277, 0}, {144, 232, 0}, {126, 165, 0}, {84, 92, 0},  {44, 38, 0},
                {36, 24, 0},  {54, 16, 0},   {60, 9, 0},    {58, 1, 0},    {46, 0, 0},    {40, 6, 0},   {0, 8, 0}});
}

double share(double y, double low, double high) { return (y - low) / (high - low); }
bool in(double y, double low, double high) { return y >= low && y < high; }

/// How much glaze covers the place: by bands of height, as potters laid them out.
double frieze(double turns, double y) {
  double const height = share(y, 178, 290), column = turns * 8, x = (column - std::floor(column) - 0.5) * 0.96;
  Figure const figure = int(std::floor(column)) % 2 == 0 ? warrior({x, height}) : horse({x, height});
  return ink(figure.body, 0.006) * (1 - ink(figure.incised, 0.003));
}

double glaze(double turns, double y) {
  if (in(y, 0, 34)) return 1;
  if (in(y, 34, 84)) return ink(rays(turns * 20, share(y, 34, 84)), 0.02);
  if (in(y, 84, 142)) return in(y, 126, 130) ? 0 : 1;
  if (in(y, 144, 168)) return meander(turns * 26, share(y, 145, 167)) && in(y, 145, 167);
  if (in(y, 178, 290)) return frieze(turns, y);
  if (in(y, 171, 174) || in(y, 294, 297)) return 1;
  if (in(y, 299, 322)) return ink(tongues(turns * 44, share(y, 299, 322)), 0.04);
  if (in(y, 326, 345)) return 1;
  if (in(y, 352, 362)) return ink(dots(turns * 26, share(y, 352, 362), 0.3), 0.05);
  if (in(y, 366, 390)) return meander(turns * 9, share(y, 366, 390));
  if (in(y, 394, 396)) return 1;
  return y > 408;
}

/// Wear shared by body and handles: worn glaze, flaked spots, soil, fine grain.
Finish wear(V3d const& p, double glazed, std::uint32_t seed) {
  double const patch = fractal(p * 0.02, 4, seed), grain = fractal(p * 0.35, 4, seed + 10);
  double const flake = step(0.46, 0.52, fractal(p * 0.055, 5, seed + 20)) * step(0.1, 0.3, noise(p * 0.01, seed + 25));
  double const cover = glazed * (1 - 0.25 * step(0.1, 0.7, grain)) * (1 - flake);
  V3d const clay = kClay * (1 + 0.14 * patch + 0.07 * grain),
            black = kGlaze * (1 + 0.8 * step(0, 1, patch)) + V3d(0.02) * grain;
  double const soil = step(0.15, 0.75, fractal(p * 0.045, 5, seed + 30)) * 0.5;
  return {0.12 * grain - 0.45 * flake + 0.06 * cover,
          mix(mix(clay, black, cover), kEarth * (1 + 0.2 * grain), soil * (0.35 + 0.65 * flake))};
}

Part body(std::uint32_t seed) {
  Curve const curve = profile();
  auto const place = [=](Uv const& uv) {
    V3d const p = turn(curve, uv.u, uv.v);
    return p + V3d(p.x, 0, p.z) * (0.006 * noise(p * 0.012, seed + 3));  // a hand-thrown pot is never quite round
  };
  auto const finish = [=](Uv const& uv, V3d const& p) {
    bool const inside = uv.v < 0.16;
    Finish worn = wear(p, inside ? step(0.07, 0.12, uv.v) : glaze(uv.u, p.y), seed);
    worn.height += 0.1 * std::sin(p.y * 1.9 + 0.6 * noise(p * 0.03, seed + 4));  // the wheel's rings
    return worn;
  };
  return {Topology::ball, place, finish};
}

/// A strap from the neck to the shoulder; its ends lie inside the body.
Part handle(double side, std::uint32_t seed) {
  Curve const curve({{42, 398, 0}, {78, 408, 0}, {112, 398, 0}, {128, 366, 0}, {124, 330, 0}, {112, 296, 0}});
  auto const place = [=](Uv const& uv) {
    double const v = uv.v, end = std::clamp((std::abs(2 * v - 1) - 0.92) / 0.08, 0.0, 1.0);
    double const size = std::sqrt(std::max(0.0, 1 - end * end)), angle = 2 * kPi * uv.u;
    V3d const centre = curve.at(v), along = (curve.at(v + 0.01) - curve.at(v - 0.01)).normalized();
    V3d const across(along.y, -along.x, 0);
    V3d const p = centre + (across * (6.5 * std::cos(angle)) + V3d(0, 0, 1) * (13 * std::sin(angle))) * size;
    return V3d(p.x * side, p.y, p.z * side);
  };
  return {Topology::ball, place, [=](Uv const&, V3d const& p) { return wear(p, 1, seed); }};
}

}  // namespace

std::vector<Part> amphora(std::uint32_t seed) { return {body(seed), handle(1, seed), handle(-1, seed)}; }

}  // namespace vitrine::sample
