// SPDX-License-Identifier: Apache-2.0
#include "stages/surface_samples.h"

#include "stages/closest_point.h"
#include "stages/colour.h"
#include "stages/parallel.h"

#include <algorithm>
#include <cmath>

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
  samples.radius = bounds(mesh).size().length() / 2;
  double const step = areas.back() / double(count);
  float const footprint = float(std::sqrt(step));
  parallel_blocks(count, kGrain, [&](std::size_t begin, std::size_t end) {
    auto face = std::lower_bound(areas.begin(), areas.end(), (double(begin) + 0.5) * step);
    for (std::size_t i = begin; i < end; ++i) {
      while (*face < (double(i) + 0.5) * step && face + 1 != areas.end()) ++face;
      auto const f = std::uint32_t(face - areas.begin());
      auto const& [a, b, c] = mesh.triangles[f];
      Barycentric const at = spread(i);
      V3f const p = mesh.positions[a], q = mesh.positions[b], r = mesh.positions[c];
      samples.points[i] = interpolate(p, q, r, at);
      samples.normals[i] = V3f(V3d(q - p).cross(V3d(r - p)).normalized());
      SurfaceSample const sample = original.surface.sample(Hit{f, at.u, at.v, 0}, footprint);
      samples.shading[i] = sample.normal;
      if (!samples.colours.empty()) samples.colours[i] = shown(sample.colour);
    }
  });
  return samples;
}

}  // namespace vitrine
