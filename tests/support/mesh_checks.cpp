// SPDX-License-Identifier: Apache-2.0
#include "tests/support/mesh_checks.h"

#include "stages/ray_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <utility>

namespace vitrine::test {
namespace {

/// Mean over the area of `from` of figure(face, hit), at a seeded point of each face and the closest one of `to`.
template <class Figure>
double mean(TriMesh const& from, TriMesh const& to, Figure const& figure) {
  RayScene const scene(to);
  std::mt19937 random(1);
  std::uniform_real_distribution<float> unit(0, 1);
  double sum = 0, weights = 0;
  for (Triangle const& t : from.triangles) {
    float u = unit(random), v = unit(random);
    if (u + v > 1) u = 1 - u, v = 1 - v;
    V3f const point = from.positions[t[0]] * (1 - u - v) + from.positions[t[1]] * u + from.positions[t[2]] * v;
    double const weight = area_vector(from, t).length();
    sum += weight * figure(t, *scene.closest_point(point, std::numeric_limits<float>::max(), V3f(0)));
    weights += weight;
  }
  return sum / weights;
}

}  // namespace

V3d area_vector(TriMesh const& mesh, Triangle const& t) {
  V3d const a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
  return (b - a).cross(c - a) / 2;
}

std::size_t open_edges(TriMesh const& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> passes;
  for (Triangle const& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      std::uint32_t const a = t[k], b = t[(k + 1) % 3];
      passes[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  return std::ranges::count_if(passes, [](auto const& edge) { return edge.second != 0; });
}

double mean_distance(TriMesh const& from, TriMesh const& to) {
  return mean(from, to, [](Triangle const&, Hit const& hit) { return hit.distance; }) / bounds(from).size().length();
}

double mean_angle(TriMesh const& from, TriMesh const& to) {
  return mean(from, to, [&](Triangle const& t, Hit const& hit) {
    V3d const a = area_vector(from, t), b = area_vector(to, to.triangles[hit.face]);
    return std::atan2(a.cross(b).length(), a.dot(b));
  });
}

}  // namespace vitrine::test
