// SPDX-License-Identifier: Apache-2.0
#include "tools/sample/draw.h"
#include "tools/sample/objects.h"

namespace vitrine::sample {
namespace {

constexpr double kTurns = 4.2, kGrowth = 2.15, kMouth = 46;  // whorls, growth of each, radius at the mouth in mm

/// Angle along the spiral, such that v runs evenly over the shell's length.
double angle_at(double v) {
  double const first = std::pow(kGrowth, -kTurns);
  return 2 * kPi * (kTurns + std::log(mix(first, 1, v)) / std::log(kGrowth));
}

double radius_at(double angle) { return kMouth * std::pow(kGrowth, angle / (2 * kPi) - kTurns); }

V3d place(Uv const& uv) {
  double const angle = angle_at(uv.v), radius = radius_at(angle), section = 2 * kPi * uv.u;
  double const lip = std::sqrt(std::max(0.0, 1 - std::pow(std::clamp((uv.v - 0.985) / 0.015, 0.0, 1.0), 2)));
  double const tip = std::sqrt(std::clamp(uv.v / 0.004, 0.0, 1.0));
  double const size = radius * lip * tip,
               keel = 1 + 0.08 * std::exp(-std::pow(std::remainder(section, 2 * kPi) / 0.25, 2));
  double const out = radius + 0.42 * size * std::cos(section) * keel;
  return {out * std::cos(angle), out * std::sin(angle), 0.34 * size * std::sin(section)};
}

/// Ribs bend forward and fork towards the outer edge.
double ribs(double angle, double outward) {
  double const bent = angle + 0.16 * outward * outward;
  double const coarse = 0.5 + 0.5 * std::cos(26 * bent), fine = 0.5 + 0.5 * std::cos(52 * bent);
  return std::pow(mix(coarse, fine, step(0.1, 0.8, outward)), 1.4);
}

Finish finish(Uv const& uv, V3d const& p, std::uint32_t seed) {
  double const angle = angle_at(uv.v), radius = radius_at(angle), outward = std::cos(2 * kPi * uv.u);
  double const rib = ribs(angle, outward) * step(0, 0.05, uv.v) * step(0.985, 0.97, uv.v),
               grain = fractal(p * 0.5, 5, seed);
  double const frill = 0.035 * std::sin(17 * outward + 3) + 0.018 * std::sin(41 * outward),
               partition = angle * 2.6 + 8 * frill;
  double const suture = std::exp(-std::pow((partition - std::round(partition)) / 0.035, 2)) * step(0.9, 0.86, uv.v);
  double const loss = step(0.25, 0.4, fractal(p * 0.05, 5, seed + 1));  // shell lost: the stony core shows its sutures
  double const hue = 1.1 * fractal(p * 0.03, 4, seed + 2) + 0.12 * rib + 0.3 * outward;
  V3d const nacre = V3d(0.66, 0.54, 0.41) +
                    V3d(std::cos(5 * hue), std::cos(5 * hue - 2.1), std::cos(5 * hue - 4.2)) * V3d(0.1, 0.09, 0.08);
  V3d const stone = mix(V3d(0.36, 0.27, 0.19), V3d(0.55, 0.43, 0.30), step(-0.5, 0.5, grain));
  V3d const colour = mix(nacre * (0.72 + 0.36 * rib), stone * (1 - 0.55 * suture), loss) * (1 + 0.1 * grain);
  double const height =
      radius * (0.045 * rib - 0.012 * suture * loss - 0.014 * loss) + 0.1 * grain * step(0, 0.2, uv.v);
  return {height, mix(colour, V3d(0.42, 0.37, 0.30), 0.5 * step(0.2, 0.6, fractal(p * 0.12, 4, seed + 4)) * (1 - rib))};
}

}  // namespace

std::vector<Part> fossil(std::uint32_t seed) {
  return {{Topology::ball, place, [=](Uv const& uv, V3d const& p) { return finish(uv, p, seed); }}};
}

}  // namespace vitrine::sample
