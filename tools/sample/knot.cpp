// SPDX-License-Identifier: Apache-2.0
#include "tools/sample/draw.h"
#include "tools/sample/objects.h"

namespace vitrine::sample {
namespace {

/// A (2, 3) torus knot about the z axis.
V3d centre(double v) {
  double const t = 2 * kPi * v, ring = 34 + 15 * std::cos(3 * t);
  return {ring * std::cos(2 * t), ring * std::sin(2 * t), 15 * std::sin(3 * t)};
}

/// Axes across the body: `up` leans away from the knot's middle and never meets the direction of travel.
struct Frame {
  V3d out, side;
};
Frame frame(double v) {
  V3d const along = (centre(v + 1e-4) - centre(v - 1e-4)).normalized();
  double const t = 2 * kPi * v;
  V3d const core(34 * std::cos(2 * t), 34 * std::sin(2 * t), 0);
  V3d const lean = centre(v) - core;
  V3d const out = (lean - along * lean.dot(along)).normalized();
  return {out, out.cross(along)};
}

V3d place(Uv const& uv) {
  Frame const axes = frame(uv.v);
  double const angle = 2 * kPi * uv.u, size = 7.2 + 1.3 * std::sin(2 * kPi * uv.v) + 0.5 * std::sin(14 * kPi * uv.v);
  return centre(uv.v) + (axes.out * std::cos(angle) + axes.side * std::sin(angle)) * size;
}

/// Overlapping scales in rows; 0..1, highest at each scale's free edge.
double scales(double u, double v) {
  double const row = v * 150, line = std::floor(row), x = u * 18 + 0.5 * (int(line) & 1), y = row - line;
  V2d const p(x - std::floor(x) - 0.5, y);
  double const own = disc(p, {0, 0.05}, 0.72);
  return 0.25 + 0.75 * y * ink(own, 0.04);
}

Finish finish(Uv const& uv, V3d const& p, std::uint32_t seed) {
  double const back = std::abs(uv.u < 0.5 ? uv.u : 1 - uv.u);  // 0 on the spine
  double const spine = step(0.05, 0.02, back) * std::pow(0.5 + 0.5 * std::cos(2 * kPi * 75 * uv.v), 2);
  double const belly = step(0.36, 0.4, back), bars = 0.5 + 0.5 * std::cos(2 * kPi * 150 * uv.v);
  double const scale = scales(uv.u, uv.v), grain = fractal(p * 0.8, 4, seed + 3);
  double const height = mix(0.75 * scale, 0.5 * bars, belly) + 2.6 * spine + 0.03 * grain;
  V3d const warp(fractal(p * 0.05, 4, seed), fractal(p * 0.05, 4, seed + 1), fractal(p * 0.05, 4, seed + 2));
  double const vein = 1 - std::abs(fractal(p * 0.045 + warp * 0.9, 5, seed + 6)) * 3, cloud = 0.5 + warp.x;
  V3d const deep(0.16, 0.36, 0.22), light(0.56, 0.73, 0.52), rust(0.62, 0.45, 0.24);
  V3d colour = mix(deep, light, std::clamp(0.35 + 0.55 * cloud + 0.12 * grain, 0.0, 1.0));
  colour = mix(colour, V3d(0.82, 0.86, 0.74), 0.45 * step(0.75, 1, vein));
  colour = mix(colour, rust, 0.75 * step(0.3, 0.65, fractal(p * 0.03, 4, seed + 11)));
  return {height, colour * mix(0.62, 1.05, step(0, 0.8, mix(scale, bars, belly) + spine))};
}

}  // namespace

std::vector<Part> knot(std::uint32_t seed) {
  return {{Topology::torus, place, [=](Uv const& uv, V3d const& p) { return finish(uv, p, seed); }}};
}

}  // namespace vitrine::sample
