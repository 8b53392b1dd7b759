// SPDX-License-Identifier: Apache-2.0
#include "tools/sample/draw.h"
#include "tools/sample/objects.h"

namespace vitrine::sample {
namespace {

double bump(double x, double width) { return std::exp(-(x / width) * (x / width)); }
double bump(V2d p, V2d centre, V2d width) { return bump(p.x - centre.x, width.x) * bump(p.y - centre.y, width.y); }

/// How deep the place lies in the lines that the eyes, nostrils and mouth draw, 0..1.
double creases(V2d p) {
  V2d const half(std::abs(p.x), p.y);
  double const lash = bump(p.y - 0.16 - 0.9 * (half.x - 0.31) * (half.x - 0.31), 0.011) * step(0.47, 0.42, half.x) *
                      step(0.13, 0.18, half.x);
  double const mouth = bump(p.y + 0.385 - 0.5 * p.x * p.x, 0.012) * step(0.25, 0.18, half.x);
  return std::max({lash, mouth, bump(half, {0.055, -0.205}, {0.028, 0.018})});
}

/// Millimetres that the face rises above the plain dome; x right, y up, the rim at radius 1.
double face(V2d p) {
  V2d const half(std::abs(p.x), p.y);
  double rise = 9 * bump(half, {0.4, -0.08}, {0.2, 0.16}) + 10 * bump(p, {0, -0.64}, {0.18, 0.12});  // cheeks, chin
  rise += 6.5 * bump(p.y - 0.35 + 0.7 * (half.x - 0.3) * (half.x - 0.3), 0.026) * step(0.06, 0.12, half.x) *
          step(0.6, 0.5, half.x);
  double const almond = V2d((half.x - 0.31) / 0.17, (p.y - 0.17) / 0.085).length();
  rise += -9 * bump(half, {0.31, 0.19}, {0.2, 0.12}) + 12 * step(1.05, 0.25, almond) + 2.8 * bump(almond - 1, 0.13);
  double const along = std::clamp((0.32 - p.y) / 0.46, 0.0, 1.0);
  double const bridge = step(-0.235, -0.16, p.y) * step(0.44, 0.28, p.y);
  rise += bridge * mix(9, 26, along) * bump(p.x, mix(0.05, 0.08, along));
  rise += 8 * bump(half, {0.1, -0.155}, {0.04, 0.045});
  rise += 8 * bump(p, {0, -0.335}, {0.17, 0.035}) + 8.5 * bump(p, {0, -0.435}, {0.14, 0.04});
  return rise - 4 * creases(p);
}

/// Chased lines and punched dots: beard, moustache, diadem, rim.
double ornament(V2d p) {
  double const radius = p.length(), angle = std::atan2(p.y, p.x);
  double rise = 0;
  double const beard = step(0.5, 0.6, radius) * step(-0.3, -0.42, p.y) * step(0.9, 0.86, radius);
  rise += 1.1 * beard * std::sin(70 * (angle + 0.12 * std::sin(22 * radius)));
  double const moustache =
      bump(p.y + 0.27 + 0.35 * p.x * p.x, 0.03) * step(0.03, 0.06, std::abs(p.x)) * step(0.34, 0.26, std::abs(p.x));
  rise += moustache * (4 + 0.9 * std::sin(90 * p.y + 60 * std::abs(p.x)));
  if (p.y > 0.58 && radius < 0.88) {
    double const x = p.x / 0.2, row = (p.y - 0.6) / 0.2;
    V2d const cell(x - std::round(x), row - std::floor(row) - 0.5);
    double const r = cell.length();
    rise += step(0.58, 0.6, p.y) * (2.2 * bump(r, 0.14) + 1.3 * bump(r - 0.32, 0.06));
  }
  double const around = angle / (2 * kPi) * 72;
  rise += 1.8 * bump(V2d((around - std::round(around)) * 2 * kPi * 0.93 / 72, radius - 0.93).length(), 0.018);
  return rise + 1.5 * bump(radius - 0.885, 0.012) + 2 * step(0.975, 1, radius);
}

V3d place(Uv const& uv) {
  V2d const p = square_to_disc(uv.u, uv.v);
  double const radius2 = p.length2(), jaw = 1 - 0.1 * step(0, -1, p.y) * std::abs(p.x);
  return {82 * p.x * jaw, 108 * p.y, 50 * std::sqrt(1.04 - 0.98 * radius2) - 10 + face(p)};
}

Finish finish(Uv const& uv, V3d const& p, std::uint32_t seed) {
  V2d const q = square_to_disc(uv.u, uv.v);
  double const chased = ornament(q), grain = fractal(p * 0.25, 4, seed), dents = fractal(p * 0.045, 3, seed + 1);
  Cell const hammer = cells(p * 0.13, seed + 2);
  double const fold =
      bump(fractal(p * 0.012, 3, seed + 3) - 0.1, 0.012) * step(0.7, 0.95, q.length());  // crumpled at the edge
  double const dirt = step(0.1, -1.2, chased - 1.2 * fold + 0.8 * grain - 2 * creases(q)) +
                      0.8 * step(0.25, 0.6, fractal(p * 0.035, 5, seed + 4));
  V3d const gold = mix(V3d(0.80, 0.57, 0.18), V3d(0.93, 0.75, 0.36), step(-0.6, 0.6, dents + 0.3 * grain));
  V3d const red(0.55, 0.27, 0.12);
  V3d colour = mix(gold, red, 0.55 * step(0.2, 0.7, fractal(p * 0.02, 4, seed + 5)));
  colour = mix(colour, V3d(0.32, 0.23, 0.14), 0.55 * std::min(dirt, 1.0));
  return {chased - 0.5 * (1 - std::min(1.0, hammer.nearest * 1.3)) + 0.9 * dents + 0.05 * grain - 0.9 * fold,
          colour * (1 + 0.08 * grain)};
}

}  // namespace

std::vector<Part> mask(std::uint32_t seed) {
  return {{Topology::sheet, place, [=](Uv const& uv, V3d const& p) { return finish(uv, p, seed); }}};
}

}  // namespace vitrine::sample
