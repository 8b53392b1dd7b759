// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Drawing in the plane for the sample objects: signed distances (negative inside), bands of ornament, and smooth
/// curves.

#include "tools/sample/noise.h"

#include <vector>

namespace vitrine::sample {

constexpr double kPi = 3.14159265358979323846;

inline V3d mix(V3d const& a, V3d const& b, double t) { return a + (b - a) * t; }

// ---- Signed distances ----
inline double disc(V2d p, V2d centre, double radius) { return (p - centre).length() - radius; }
double ellipse(V2d p, V2d centre, V2d radii);                        ///< approximate away from the edge
double limb(V2d p, V2d a, V2d b, double radius_a, double radius_b);  ///< a stroke that thins from a to b
double box(V2d p, V2d centre, V2d half);
/// Union that rounds the joint over about `k`.
double blend(double a, double b, double k);

/// 1 inside, 0 outside, soft over `width`.
inline double ink(double distance, double width) { return 1 - step(-width, width, distance); }
/// Height of a cushion of that outline: rises over `width` to 1.
inline double cushion(double distance, double width) {
  double const t = std::clamp(-distance / width, 0.0, 1.0);
  return std::sqrt(t * (2 - t));
}

// ---- Ornament; x runs along the band, one motif a unit, y in 0..1 up ----
bool meander(double x, double y);    ///< the Greek key
double rays(double x, double y);     ///< distance to upright triangles
double tongues(double x, double y);  ///< distance to hanging tongues
double dots(double x, double y, double radius);

/// A figure of about unit height standing on y = 0, x in about -0.5..0.5.
struct Figure {
  double body;     ///< distance to the silhouette
  double incised;  ///< distance to the lines scratched into it
};
Figure warrior(V2d p);
Figure horse(V2d p);

/// Smooth curve through points (cubic pieces), by arc length: at(0) first point, at(1) last. A doubled point is
/// a corner.
class Curve {
 public:
  explicit Curve(std::vector<V3d> points);
  V3d at(double t) const;
  double length() const { return lengths_.back(); }

 private:
  std::vector<V3d> samples_;
  std::vector<double> lengths_;
};

/// Turns a profile (x: radius, y: height) about the y axis: u the angle, v along the profile.
inline V3d turn(Curve const& profile, double u, double v) {
  V3d const p = profile.at(v);
  return {p.x * std::sin(2 * kPi * u), p.y, p.x * std::cos(2 * kPi * u)};
}

/// The unit square (u, v) onto the unit disc, without a pole. Source: Shirley and Chiu 1997, "A Low Distortion Map".
V2d square_to_disc(double u, double v);

}  // namespace vitrine::sample
