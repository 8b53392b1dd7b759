// SPDX-License-Identifier: Apache-2.0
#include "tools/sample/draw.h"
#include "tools/sample/objects.h"

namespace vitrine::sample {
namespace {

// The face looks along -y; z is up; the left half mirrors the right one, so most solids take |x|.

double blob(V3d const& p, V3d const& centre, V3d const& radii) {
  V3d const q = p - centre;
  double const k = (q / radii).length(), g = (q / (radii * radii)).length();
  return g < 1e-9 ? -std::min({radii.x, radii.y, radii.z}) : k * (k - 1) / g;
}

double rod(V3d const& p, V3d const& a, V3d const& b, double radius_a, double radius_b) {
  V3d const along = b - a;
  double const t = std::clamp((p - a).dot(along) / along.length2(), 0.0, 1.0);
  return (p - a - along * t).length() - mix(radius_a, radius_b, t);
}

double carve(double solid, double tool, double k) { return -blend(-solid, tool, k); }

double skull(V3d const& p) {
  double d = blob(p, {0, 18, 38}, {77, 96, 92});
  d = blend(d, blob(p, {0, -30, -22}, {63, 66, 92}), 30);
  d = blend(d, blob(p, {46, -52, -26}, {20, 26, 18}), 24);           // cheekbone
  d = blend(d, rod(p, {34, -46, -82}, {0, -78, -104}, 18, 19), 22);  // jaw
  return blend(d, rod(p, {10, -92, 31}, {48, -76, 27}, 7, 6), 13);   // brow
}

double face(V3d const& p, double d) {
  d = carve(d, blob(p, {31, -97, 9}, {19, 15, 12}), 12);          // socket
  d = blend(d, blob(p, {30, -78, 8}, {15, 14, 13}), 2);           // eye
  d = blend(d, rod(p, {18, -90, 15}, {44, -83, 14}, 3.2, 3), 3);  // lids
  d = blend(d, rod(p, {19, -90, 2}, {43, -82, 3}, 2.2, 2), 3);
  d = blend(d, rod(p, {0, -98, 22}, {0, -125, -30}, 7.5, 9.5), 11);  // nose
  d = blend(d, blob(p, {10, -107, -33}, {8.5, 11, 7.5}), 6);
  d = carve(d, blob(p, {6.5, -112, -41}, {3.4, 6, 3}), 3);
  d = blend(d, rod(p, {0, -106, -61}, {21, -93, -64}, 5.5, 2.5), 5);  // lips
  d = blend(d, rod(p, {0, -104, -73}, {18, -93, -70}, 6.5, 3), 5);
  d = carve(d, rod(p, {0, -111.5, -66.8}, {22, -98, -67}, 1.8, 1.2), 2.5);
  double const ear = carve(blob(p, {77, 14, -4}, {9, 20, 31}), blob(p, {86, 10, 0}, {6, 11, 19}), 5);
  return blend(d, ear, 6);
}

double beard(V3d const& p) {
  double d = blend(rod(p, {68, 2, -34}, {50, -48, -84}, 9, 15), rod(p, {50, -48, -84}, {0, -80, -116}, 15, 25), 10);
  d = blend(d, blob(p, {0, -76, -128}, {30, 24, 36}), 14);
  return std::min(d, rod(p, {3, -109, -54}, {27, -92, -66}, 5, 4));  // moustache
}

double shoulders(V3d const& p) {
  double d = rod(p, {0, 22, -60}, {0, 32, -190}, 52, 60);
  d = blend(d, blob(p, {0, 36, -226}, {128, 60, 62}), 50);
  d = blend(d, blob(p, {100, 40, -226}, {50, 44, 56}), 34);
  d = blend(d, rod(p, {0, 38, -230}, {0, 30, -300}, 62, 40), 40);
  d = std::max(d, -304 - p.z);
  double const round = V2d(p.x, p.y - 28).length();
  double const profile = 52 + 20 * step(-316, -344, p.z) - 10 * step(4, 0, std::abs(p.z + 312));
  return blend(d, std::max(round - profile, std::abs(p.z + 325) - 25), 4);
}

double solid(V3d p) {
  p.x = std::sqrt(p.x * p.x + 0.5);  // the mirror, without a crease
  double const head = face(p, skull(p));
  return blend(blend(head, beard(p), 9), shoulders(p), 24);
}

/// Wraps the parameter square around the solid: rays come in towards an upright axis, as a capsule's normals do.
V3d place(Uv const& uv) {
  constexpr double kFar = 420;
  V3d const low(0, 24, -300), high(0, 6, 20);
  double const fall = uv.v * 1.5 - 0.25;  // 0..1 along the axis, beyond it around its ends
  V3d const foot = mix(high, low, std::clamp(fall, 0.0, 1.0));
  double const rise = kPi / 2 * (fall < 0 ? -fall / 0.25 : fall > 1 ? (1 - fall) / 0.25 : 0);
  double const angle = 2 * kPi * uv.u;
  V3d const out(std::cos(rise) * std::sin(angle), -std::cos(rise) * std::cos(angle), std::sin(rise));
  double t = kFar;
  for (int i = 0; i < 96; ++i) {
    double const d = solid(foot + out * t);
    t -= 0.8 * d;
    if (std::abs(d) < 1e-4) break;
  }
  return foot + out * t;
}

V3d normal(V3d const& p) {
  constexpr double kStep = 1e-3;
  V3d sum(0);
  for (V3d const& corner : {V3d(1, -1, -1), V3d(-1, -1, 1), V3d(-1, 1, -1), V3d(1, 1, 1)})
    sum += corner * solid(p + corner * kStep);
  return sum.normalized();
}

Finish finish(V3d const& p, std::uint32_t seed) {
  double const grain = fractal(p * 0.25, 5, seed), stain = fractal(p * 0.02, 4, seed + 8);
  double const hairline = 66 - 0.6 * (p.y + 100) + 14 * noise(p * 0.035, seed + 2);
  double const scalp = step(-5, 7, p.z - hairline) * step(-66, -44, p.z) * step(88, 80, std::abs(p.x));
  double const whiskers = step(2.5, -1, beard(p - V3d(2 * std::min(p.x, 0.0), 0, 0)));
  V3d const swirl(noise(p * 0.03, seed + 3), noise(p * 0.03, seed + 4), noise(p * 0.03, seed + 5));
  double const lock = noise(V3d(p.x * 0.075, p.y * 0.075, p.z * 0.04) + swirl * 1.1, seed + 6);
  double const strand = noise(V3d(p.x * 0.3, p.y * 0.3, p.z * 0.12) + swirl * 3.5, seed + 7);
  double const hair = 3 + 4.5 * (1 - std::abs(lock) * 2.4) + 1.1 * strand;
  double const chip = step(0.4, 0.48, fractal(p * 0.02, 5, seed + 12));
  return {std::max(scalp, 0.8 * whiskers) * hair + 0.2 * grain - 2.2 * chip,
          V3d(0.86, 0.83, 0.77) * (1 + 0.06 * grain + 0.08 * stain)};
}

}  // namespace

std::vector<Part> bust(std::uint32_t seed) {
  return {{Topology::ball, place, [=](Uv const&, V3d const& p) { return finish(p, seed); }, normal}};
}

}  // namespace vitrine::sample
