// SPDX-License-Identifier: Apache-2.0
#include "stages/surface_samples.h"

#include "stages/clean.h"
#include "stages/closest_point.h"
#include "stages/colour.h"
#include "stages/crease.h"
#include "stages/edges.h"
#include "stages/parallel.h"
#include "stages/swatches.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace vitrine {
namespace {

constexpr std::size_t kGrain = 4096;

/// Per face the area up to its end.
std::vector<double> running_areas(TriMesh const& mesh) {
  std::vector<double> areas(mesh.triangles.size());
  parallel_for(areas.size(), kGrain, [&](std::size_t f) {
    auto const& [a, b, c] = mesh.triangles[f];
    V3d const p(mesh.positions[a]);
    areas[f] = (V3d(mesh.positions[b]) - p).cross(V3d(mesh.positions[c]) - p).length() / 2;
  });
  double sum = 0;
  for (double& area : areas) area = sum += area;
  return areas;
}

V3d face_normal(TriMesh const& mesh, std::uint32_t face) {
  auto const& [a, b, c] = mesh.triangles[face];
  V3d const p(mesh.positions[a]);
  return (V3d(mesh.positions[b]) - p).cross(V3d(mesh.positions[c]) - p).normalized();
}

/// Steps along one line after the other as if they were one.
class Pacer {
 public:
  explicit Pacer(double step) : step_(step), next_(step / 2) {}

  /// visit(share) for each place on a line that counts as this long, 0 <= share < 1.
  template <class Visit>
  void walk(double length, Visit const& visit) {
    for (; next_ < length; next_ += step_) visit(float(next_ / length));
    next_ -= length;
  }

 private:
  double step_, next_;
};

/// What for_edges meets where a welded mesh ends or bends sharply.
struct Line {
  V3f from, to;
  double length;  ///< that it counts as
  V3f normal;     ///< zero on the outline
};

std::vector<Line> lines(TriMesh const& mesh) {
  constexpr double kSharp = std::numbers::pi / 3;
  std::vector<Line> found;
  for_edges(mesh, [&](std::span<FaceEdge const> edge) {
    auto const [a, b] = ends(mesh, edge[0]);
    V3f const from = mesh.positions[a], to = mesh.positions[b];
    if (edge.size() == 1) found.push_back({from, to, (to - from).length(), V3f(0)});
    if (edge.size() != 2) return;
    V3d const n = face_normal(mesh, edge[0].face), m = face_normal(mesh, edge[1].face), turn = n.cross(m);
    double const angle = std::atan2(turn.length(), n.dot(m));
    bool const ridge = turn.dot(V3d(to - from)) > 0;
    V3d const normal = (n + m).normalized();
    if (ridge && angle >= kSharp && normal != V3d(0))
      found.push_back({from, to, (to - from).length() * angle / std::numbers::pi, V3f(normal)});
  });
  return found;
}

/// Fills outline and ridges: places `step` apart, farther where that would be more than `most`.
void sample_lines(TriMesh const& mesh, double step, std::size_t most, SurfaceSamples& samples) {
  std::vector<Line> const all = lines(mesh);
  double length = 0;
  for (Line const& line : all) length += line.length;
  Pacer pacer(std::max(step, length / double(most)));
  for (auto const& [from, to, size, normal] : all)
    pacer.walk(size, [&, from = from, to = to, normal = normal](float share) {
      V3f const point = from + (to - from) * share;
      if (normal == V3f(0))
        samples.outline.push_back(point);
      else
        samples.ridges.push_back({point, (to - from).normalized(), normal});
    });
}

/// The i-th place of a triangle.
Barycentric spread(std::size_t i) {
  double whole;
  double u = std::modf(0.5 + double(i) * 0.7548776662466927, &whole);
  double v = std::modf(0.5 + double(i) * 0.5698402909980532, &whole);
  if (u + v > 1) u = 1 - u, v = 1 - v;
  return {float(u), float(v)};
}

V4f shown(Rgba const& linear) {
  return {linear_to_srgb(linear[0]), linear_to_srgb(linear[1]), linear_to_srgb(linear[2]), linear[3]};
}

}  // namespace

SurfaceSamples sample_surface(SurveyedModel const& original, std::size_t count) {
  TriMesh const& mesh = original.model->mesh;
  std::vector<double> const areas = running_areas(mesh);
  SurfaceSamples samples;
  samples.points.resize(count), samples.normals.resize(count), samples.shading.resize(count);
  if (original.surface.coloured()) samples.colours.resize(count);
  samples.creased = has_creases(*original.model);
  samples.radius = bounds(mesh).size().length() / 2;
  double const step = areas.back() / double(count);
  float const footprint = float(std::sqrt(step));
  sample_lines(weld(*original.model), footprint, count / 4, samples);
  parallel_blocks(count, kGrain, [&](std::size_t begin, std::size_t end) {
    auto face = std::lower_bound(areas.begin(), areas.end(), (double(begin) + 0.5) * step);
    for (std::size_t i = begin; i < end; ++i) {
      while (*face < (double(i) + 0.5) * step && face + 1 != areas.end()) ++face;
      auto const f = std::uint32_t(face - areas.begin());
      auto const& [a, b, c] = mesh.triangles[f];
      Barycentric const at = spread(i);
      V3f const p = mesh.positions[a], q = mesh.positions[b], r = mesh.positions[c];
      samples.points[i] = interpolate(p, q, r, at);
      samples.normals[i] = V3f(face_normal(mesh, f));
      SurfaceSample const sample = original.surface.sample(Hit{f, at.u, at.v, 0}, footprint);
      samples.shading[i] = sample.normal;
      if (!samples.colours.empty()) samples.colours[i] = shown(sample.colour);
    }
  });
  samples.flat = flat_colours(samples);
  return samples;
}

}  // namespace vitrine
