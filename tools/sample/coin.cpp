// SPDX-License-Identifier: Apache-2.0
#include "tools/sample/draw.h"
#include "tools/sample/objects.h"

namespace vitrine::sample {
namespace {

constexpr double kRadius = 12.5, kHalfThickness = 1.9;

/// Heights of the owl, in 0..1; the coin's radius is 1.
double owl(V2d p) {
  double const body = limb(p, {0.02, 0.06}, {-0.12, -0.36}, 0.32, 0.13), head = ellipse(p, {0.06, 0.34}, {0.3, 0.25});
  double height = 0.75 * cushion(blend(body, head, 0.1), 0.24);
  double const wing = limb(p, {-0.12, 0.12}, {-0.3, -0.46}, 0.16, 0.03);
  height = std::max(height, (0.62 + 0.06 * std::sin(34 * (p.y + 0.5 * p.x))) * cushion(wing, 0.07));
  for (double const x : {-0.06, 0.19}) {
    double const eye = (p - V2d(x, 0.36)).length();
    height +=
        0.22 * ink(std::abs(eye - 0.1) - 0.018, 0.018) + 0.3 * ink(eye - 0.042, 0.02) - 0.16 * ink(eye - 0.082, 0.012);
  }
  height = std::max(height, cushion(limb(p, {0.065, 0.33}, {0.065, 0.2}, 0.035, 0.01), 0.04));
  if (body < 0)
    height += 0.07 * ink(dots((p.x + 0.5 * std::floor(p.y * 12)) * 12, p.y * 12 - std::floor(p.y * 12), 0.26), 0.1);
  for (double const x : {0.0, 0.13}) {
    height = std::max(height, 0.5 * cushion(limb(p, {x - 0.05, -0.3}, {x, -0.56}, 0.055, 0.035), 0.05));
    for (double const toe : {-0.09, 0.0, 0.09})
      height = std::max(height, 0.45 * cushion(limb(p, {x, -0.56}, {x + toe, -0.64}, 0.028, 0.018), 0.03));
  }
  return height;
}

/// Olive sprig on the left, three letters on the right, a ring of beads around.
double legend(V2d p) {
  double height = cushion(limb(p, {-0.6, 0.2}, {-0.42, 0.56}, 0.016, 0.012), 0.02) * 0.4;
  for (V2d const& leaf : {V2d(-0.64, 0.46), V2d(-0.38, 0.36)})
    height = std::max(height, 0.5 * cushion(limb(p, {-0.52, 0.34}, leaf, 0.012, 0.05), 0.05));
  auto const stroke = [&](V2d a, V2d b) {
    height = std::max(height, 0.5 * cushion(limb(p, a, b, 0.024, 0.024), 0.025));
  };
  stroke({0.5, 0.28}, {0.58, 0.48}), stroke({0.58, 0.48}, {0.66, 0.28}), stroke({0.53, 0.35}, {0.63, 0.35});
  height = std::max(height, 0.5 * cushion(std::abs(disc(p, {0.62, 0.06}, 0.09)) - 0.02, 0.022));
  stroke({0.54, 0.06}, {0.7, 0.06});
  stroke({0.5, -0.34}, {0.5, -0.14});
  for (double const y : {-0.34, -0.24, -0.14}) stroke({0.5, y}, {0.62, y});
  double const angle = std::atan2(p.y, p.x) / (2 * kPi) * 64, around = angle - std::floor(angle) - 0.5;
  V2d const bead(around * 2 * kPi * 0.88 / 64, p.length() - 0.88);
  return std::max(height, 0.4 * cushion(bead.length() - 0.03, 0.03));
}

/// The other side: an eight-rayed star in an incuse square.
double star(V2d p) {
  double const angle = std::atan2(p.y, p.x), radius = p.length();
  double const ray = std::abs(std::remainder(angle, kPi / 4)) * radius - 0.085 * (1 - radius / 0.62);
  double const square = box({0.94 * p.x + 0.34 * p.y, 0.94 * p.y - 0.34 * p.x}, {0, 0}, {0.6, 0.6});
  double const relief = std::max(0.8 * cushion(radius < 0.62 ? ray : 1, 0.05), cushion(radius - 0.13, 0.1));
  return relief + 0.45 * step(-0.02, 0.04, square);
}

V3d place(Uv const& uv, std::uint32_t seed) {
  V2d const q = square_to_disc(uv.u, uv.v);
  double const s = q.length(), bend = 0.8, side = uv.back ? -1 : 1;
  if (s < 1e-9) return {0, 0, side * kHalfThickness};
  double const turn =
      std::clamp((s - bend) / (1 - bend), 0.0, 1.0) * kPi / 2;  // faces flat, edge a quarter circle each
  double const radius = kRadius * (0.9 * std::min(s / bend, 1.0) + 0.1 * std::sin(turn));
  V2d const d = q / s;
  double const ragged = 1 + 0.045 * noise({d.x * 1.3, d.y * 1.3, 0.5}, seed) * step(0.3, 1, s);
  return {d.x * radius * ragged, d.y * radius * ragged, side * kHalfThickness * std::cos(turn)};
}

Finish finish(Uv const& uv, V3d const& p, std::uint32_t seed) {
  V2d const face = V2d(p.x, p.y) / kRadius;
  double const design = uv.back ? star(face) : std::max(owl(face), legend(face));
  double const relief = design * step(0.05, 0.5, std::abs(p.z) / kHalfThickness);
  double const grain = fractal(p * 0.9, 5, seed + 2), pit = step(0.35, 0.55, fractal(p * 1.7, 4, seed + 9));
  double const tarnish = std::clamp(0.75 - 0.9 * relief + 0.5 * grain + 0.5 * pit, 0.0, 1.0);
  V3d const silver(0.80, 0.78, 0.73), dark(0.27, 0.24, 0.22), brown(0.44, 0.36, 0.27);
  V3d const shade = mix(dark, brown, step(-0.4, 0.5, fractal(p * 0.35, 3, seed + 5)));
  return {0.85 * relief + 0.035 * grain - 0.1 * pit, mix(silver * (1 + 0.08 * grain), shade, 0.85 * tarnish)};
}

}  // namespace

std::vector<Part> coin(std::uint32_t seed) {
  return {{Topology::pillow, [=](Uv const& uv) { return place(uv, seed); },
           [=](Uv const& uv, V3d const& p) { return finish(uv, p, seed); }}};
}

}  // namespace vitrine::sample
