// SPDX-License-Identifier: Apache-2.0
#include "tools/sample/draw.h"

#include <array>
#include <initializer_list>
#include <string_view>

namespace vitrine::sample {
namespace {

double fraction(double x) { return x - std::floor(x); }

struct Stroke {
  V2d a, b;
  double radius_a, radius_b;
};

double strokes(V2d p, std::initializer_list<Stroke> list) {
  double nearest = 1e9;
  for (Stroke const& s : list) nearest = std::min(nearest, limb(p, s.a, s.b, s.radius_a, s.radius_b));
  return nearest;
}

/// Direction of travel at b, by the chords about it; the shorter one counts more. At a corner (a doubled point): from
/// one side.
V3d tangent(V3d const& a, V3d const& b, V3d const& c) {
  double const before = (b - a).length(), after = (c - b).length();
  if (before == 0 || after == 0) return (c - a).normalized();
  return (b - a) / before * (after / (before + after)) + (c - b) / after * (before / (before + after));
}

V3d hermite(V3d const& b, V3d const& c, V3d const& leave, V3d const& arrive, double t) {
  double const s = 1 - t;
  return b * (s * s * (1 + 2 * t)) + leave * (s * s * t) - arrive * (t * t * s) + c * (t * t * (1 + 2 * s));
}

}  // namespace

double ellipse(V2d p, V2d centre, V2d radii) {
  V2d const q = p - centre;
  double const k = (q / radii).length(), g = (q / (radii * radii)).length();
  return g < 1e-12 ? -std::min(radii.x, radii.y) : k * (k - 1) / g;
}

double limb(V2d p, V2d a, V2d b, double radius_a, double radius_b) {
  V2d const along = b - a;
  double const t = std::clamp((p - a).dot(along) / std::max(along.length2(), 1e-12), 0.0, 1.0);
  return (p - a - along * t).length() - mix(radius_a, radius_b, t);
}

double box(V2d p, V2d centre, V2d half) {
  V2d const q(std::abs(p.x - centre.x) - half.x, std::abs(p.y - centre.y) - half.y);
  return V2d(std::max(q.x, 0.0), std::max(q.y, 0.0)).length() + std::min(std::max(q.x, q.y), 0.0);
}

double blend(double a, double b, double k) {
  double const h = std::max(k - std::abs(a - b), 0.0) / k;
  return std::min(a, b) - h * h * k / 4;
}

bool meander(double x, double y) {
  static constexpr std::array<std::string_view, 7> kKey{
      "#######.", "#.....#.", "#.###.#.", "#.#...#.", "#.#####.", "#.......", "########",
  };
  auto const row = std::clamp(int((1 - y) * 7), 0, 6);
  return kKey[std::size_t(row)][std::size_t(fraction(x) * 8)] == '#';
}

double rays(double x, double y) { return (std::abs(fraction(x) - 0.5) - 0.42 * (1 - y)) * 0.9; }

double tongues(double x, double y) {
  V2d const p(fraction(x) - 0.5, y);
  return std::max(limb(p, {0, 0.35}, {0, 1.5}, 0.34, 0.4), -y);
}

double dots(double x, double y, double radius) { return disc({fraction(x) - 0.5, y - 0.5}, {0, 0}, radius); }

Figure warrior(V2d p) {
  double const limbs = strokes(p, {{{-0.01, 0.46}, {0.03, 0.72}, 0.055, 0.09},  // trunk
                                   {{0.04, 0.76}, {0.06, 0.84}, 0.03, 0.035},   // neck
                                   {{0, 0.45}, {0.16, 0.27}, 0.065, 0.042},     // front leg
                                   {{0.16, 0.27}, {0.13, 0.03}, 0.045, 0.02},
                                   {{0.13, 0.015}, {0.21, 0.012}, 0.018, 0.012},
                                   {{-0.01, 0.45}, {-0.13, 0.27}, 0.065, 0.042},  // back leg
                                   {{-0.13, 0.27}, {-0.27, 0.08}, 0.045, 0.02},
                                   {{-0.27, 0.07}, {-0.2, 0.02}, 0.018, 0.012},
                                   {{-0.01, 0.74}, {-0.17, 0.7}, 0.036, 0.03},  // arm with spear
                                   {{-0.17, 0.7}, {-0.13, 0.84}, 0.03, 0.022},
                                   {{-0.42, 0.79}, {0.46, 0.9}, 0.008, 0.008},
                                   {{0.4, 0.892}, {0.5, 0.905}, 0.02, 0.002},
                                   {{0.09, 0.86}, {0.125, 0.825}, 0.03, 0.012}});  // beard
  double const crest = strokes(p, {{{0.1, 0.965}, {-0.03, 0.97}, 0.012, 0.024},
                                   {{-0.03, 0.97}, {-0.1, 0.86}, 0.024, 0.018},
                                   {{-0.1, 0.86}, {-0.11, 0.76}, 0.018, 0.006}});
  double const head = disc(p, {0.06, 0.885}, 0.058), shield = disc(p, {0.13, 0.6}, 0.155);
  double const body = std::min({limbs, crest, head, shield});
  double const rim = std::abs(shield + 0.028) - 0.005;
  double const boss = std::abs(disc(p, {0.13, 0.6}, 0.05)) - 0.005;
  double const eye = disc(p, {0.085, 0.89}, 0.009);
  double const helmet = limb(p, {0.015, 0.93}, {0.11, 0.915}, 0.004, 0.004);
  return {body, std::min({rim, boss, eye, helmet})};
}

Figure horse(V2d p) {
  double const trunk =
      blend(limb(p, {-0.19, 0.53}, {0.14, 0.54}, 0.105, 0.1),
            strokes(p, {{{0.16, 0.58}, {0.29, 0.84}, 0.085, 0.05}, {{0.3, 0.85}, {0.43, 0.74}, 0.048, 0.026}}), 0.06);
  double const legs = strokes(p, {{{0.15, 0.5}, {0.27, 0.3}, 0.055, 0.03},
                                  {{0.27, 0.3}, {0.19, 0.12}, 0.028, 0.017},
                                  {{0.19, 0.12}, {0.23, 0.09}, 0.02, 0.018},
                                  {{0.13, 0.48}, {0.14, 0.24}, 0.055, 0.028},
                                  {{0.14, 0.24}, {0.12, 0.02}, 0.027, 0.018},
                                  {{-0.22, 0.5}, {-0.17, 0.28}, 0.075, 0.034},
                                  {{-0.17, 0.28}, {-0.24, 0.03}, 0.03, 0.018},
                                  {{-0.25, 0.5}, {-0.3, 0.27}, 0.07, 0.032},
                                  {{-0.3, 0.27}, {-0.39, 0.05}, 0.03, 0.018}});
  double const trim = strokes(p, {{{-0.29, 0.57}, {-0.4, 0.5}, 0.02, 0.028},  // tail
                                  {{-0.4, 0.5}, {-0.43, 0.22}, 0.03, 0.01},
                                  {{0.28, 0.88}, {0.275, 0.95}, 0.02, 0.005},   // ear
                                  {{0.23, 0.86}, {0.1, 0.66}, 0.022, 0.018}});  // mane
  double const mane = strokes(p, {{{0.265, 0.84}, {0.13, 0.62}, 0.004, 0.004}});
  double const eye = disc(p, {0.335, 0.835}, 0.009);
  double const bridle =
      strokes(p, {{{0.34, 0.87}, {0.37, 0.74}, 0.004, 0.004}, {{0.37, 0.76}, {0.17, 0.64}, 0.004, 0.004}});
  double const girth =
      strokes(p, {{{0.07, 0.64}, {0.05, 0.44}, 0.004, 0.004}, {{-0.14, 0.63}, {-0.1, 0.44}, 0.004, 0.004}});
  return {std::min({trunk, legs, trim}), std::min({mane, eye, bridle, girth})};
}

Curve::Curve(std::vector<V3d> points) {
  constexpr int kSteps = 48;
  std::size_t const n = points.size();
  for (std::size_t i = 0; i + 1 < n; ++i) {
    V3d const &b = points[i], &c = points[i + 1];
    double const length = (c - b).length();
    if (length == 0) continue;
    V3d const leave = tangent(points[i > 0 ? i - 1 : 0], b, c) * length,
              arrive = tangent(b, c, points[std::min(i + 2, n - 1)]) * length;
    for (int s = 0; s < kSteps; ++s) samples_.push_back(hermite(b, c, leave, arrive, double(s) / kSteps));
  }
  samples_.push_back(points.back());
  lengths_.push_back(0);
  for (std::size_t i = 1; i < samples_.size(); ++i)
    lengths_.push_back(lengths_.back() + (samples_[i] - samples_[i - 1]).length());
}

V3d Curve::at(double t) const {
  double const along = std::clamp(t, 0.0, 1.0) * lengths_.back();
  auto const after = std::upper_bound(lengths_.begin() + 1, lengths_.end() - 1, along) - lengths_.begin();
  double const from = lengths_[std::size_t(after) - 1], to = lengths_[std::size_t(after)];
  double const share = to > from ? (along - from) / (to - from) : 0;
  return mix(samples_[std::size_t(after) - 1], samples_[std::size_t(after)], share);
}

V2d square_to_disc(double u, double v) {
  double const a = 2 * u - 1, b = 1 - 2 * v;
  if (a == 0 && b == 0) return {0, 0};
  bool const wide = std::abs(a) > std::abs(b);
  double const radius = wide ? a : b;
  double const angle = wide ? kPi / 4 * b / a : kPi / 2 - kPi / 4 * a / b;
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

}  // namespace vitrine::sample
