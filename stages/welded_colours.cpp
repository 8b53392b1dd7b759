// SPDX-License-Identifier: Apache-2.0
#include "stages/welded_colours.h"

#include "stages/closest_point.h"
#include "stages/colour.h"
#include "stages/parallel.h"

#include <algorithm>
#include <cmath>

namespace vitrine {
namespace {

constexpr std::uint32_t kNone = ~std::uint32_t{0};

/// Seven tenths of the weight on corner k.
Barycentric near_corner(std::size_t k) {
  constexpr float kMost = 0.7f, kRest = 0.15f;
  return {k == 1 ? kMost : kRest, k == 2 ? kMost : kRest};
}

/// Corner 3 f + k of the model that first comes to each welded vertex.
std::vector<std::uint32_t> first_corners(TriMesh const& mesh, TriMesh const& welded) {
  std::vector<std::uint32_t> first(welded.positions.size(), kNone);
  std::size_t next = 0;  // face of the welded mesh
  for (std::size_t f = 0; f < mesh.triangles.size() && next < welded.triangles.size(); ++f) {
    auto const& [a, b, c] = mesh.triangles[f];
    V3f const p = mesh.positions[a], q = mesh.positions[b], r = mesh.positions[c];
    if (p == q || q == r || r == p) continue;  // weld() drops these
    for (std::size_t k = 0; k < 3; ++k) {
      std::uint32_t& corner = first[welded.triangles[next][k]];
      if (corner == kNone) corner = std::uint32_t(3 * f + k);
    }
    ++next;
  }
  return first;
}

V3f encoded(Rgba const& linear) {
  V3f colour;
  for (int k = 0; k < 3; ++k) colour[k] = linear_to_srgb(std::clamp(linear[k], 0.f, 1.f));
  return colour;
}

/// Root of the mean square.
float mean_edge(TriMesh const& mesh) {
  double sum = 0;
  for (auto const& [a, b, c] : mesh.triangles) {
    V3f const p = mesh.positions[a], q = mesh.positions[b], r = mesh.positions[c];
    sum += double((q - p).length2()) + double((r - q).length2()) + double((p - r).length2());
  }
  return float(std::sqrt(sum / (3.0 * double(std::max<std::size_t>(mesh.triangles.size(), 1)))));
}

}  // namespace

std::vector<V3f> welded_colours(SurveyedModel const& original, TriMesh const& welded) {
  TriMesh const& mesh = original.model->mesh;
  std::vector<std::uint32_t> const first = first_corners(mesh, welded);
  std::vector<V3f> colours(welded.positions.size(), V3f(0));
  parallel_for(colours.size(), 4096, [&](std::size_t v) {
    if (first[v] == kNone) return;
    std::uint32_t const face = first[v] / 3;
    auto const& [a, b, c] = mesh.triangles[face];
    V3f const p = mesh.positions[a];
    float const area = (mesh.positions[b] - p).cross(mesh.positions[c] - p).length() / 2;
    Barycentric const at = near_corner(first[v] % 3);
    colours[v] = encoded(original.surface.sample(Hit{face, at.u, at.v, 0}, std::sqrt(area / 3)).colour);
  });
  return colours;
}

std::vector<V3f> colours_near(SurveyedModel const& original, TriMesh const& mesh) {
  float const edge = mean_edge(mesh), reach = bounds(original.model->mesh).size().length();
  std::vector<V3f> colours(mesh.positions.size(), V3f(0));
  parallel_for(colours.size(), 256, [&](std::size_t v) {
    if (auto const hit = original.scene.closest_point(mesh.positions[v], reach, V3f(0)))
      colours[v] = encoded(original.surface.sample(*hit, edge).colour);
  });
  return colours;
}

}  // namespace vitrine
