// SPDX-License-Identifier: Apache-2.0
#include "stages/crease.h"

#include "stages/clean.h"
#include "stages/vertex_fit.h"

#include <cmath>
#include <limits>
#include <utility>

namespace vitrine {
namespace {

constexpr float kSameLight = 0.866f;  ///< cosine of 30 degrees
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Each face with vertices of its own.
TriMesh apart(TriMesh const& mesh) {
  TriMesh made;
  made.positions.reserve(3 * mesh.triangles.size());
  for (Triangle const& face : mesh.triangles) {
    auto const first = static_cast<std::uint32_t>(made.positions.size());
    for (std::uint32_t v : face) made.positions.push_back(mesh.positions[v]);
    made.triangles.push_back({first, first + 1, first + 2});
  }
  return made;
}

/// Per corner, of any length; zero where its face shows no sample.
std::vector<V3f> corner_normals(TriMesh const& mesh, SurfaceSamples const& samples) {
  constexpr double kSmoothing = 0.1;
  TriMesh const corners = apart(mesh);
  return VertexFit(corners, samples)(samples.shading, std::vector<V3f>(corners.positions.size(), V3f(0)), kSmoothing);
}

bool same_light(V3f const& a, V3f const& b) {
  return a == V3f(0) || b == V3f(0) || a.dot(b) > kSameLight * std::sqrt(a.length2() * b.length2());
}

}  // namespace

bool has_creases(SourceModel const& model) {
  constexpr double kFew = 0.01;  ///< of the vertices
  std::vector<std::uint32_t> const places = shared_places(model.mesh);
  std::size_t parted = 0;
  for (std::size_t v = 0; v < places.size(); ++v) parted += !same_light(model.normals[v], model.normals[places[v]]);
  return double(parted) > kFew * double(places.size());
}

PartedMesh part_at_creases(TriMesh const& mesh, SurfaceSamples const& samples) {
  std::vector<V3f> const normals = corner_normals(mesh, samples);
  PartedMesh parted;
  std::vector<V3f> sums;                                            // per new vertex: of its corners' normals
  std::vector<std::uint32_t> newest(mesh.positions.size(), kNone);  // per vertex
  std::vector<std::uint32_t> before;                                // per new vertex: the one made before it
  auto const side_of = [&](std::uint32_t vertex, V3f const& normal) {
    std::uint32_t side = newest[vertex];
    while (side != kNone && !same_light(sums[side], normal)) side = before[side];
    if (side != kNone) return side;
    side = static_cast<std::uint32_t>(sums.size());
    sums.emplace_back(0.f);
    parted.mesh.positions.push_back(mesh.positions[vertex]);
    parted.whole.push_back(vertex);
    before.push_back(std::exchange(newest[vertex], side));
    return side;
  };
  parted.mesh.triangles = mesh.triangles;
  std::size_t corner = 0;
  for (Triangle& face : parted.mesh.triangles)
    for (std::uint32_t& v : face) {
      v = side_of(v, normals[corner]);
      sums[v] += normals[corner++];
    }
  return parted;
}

}  // namespace vitrine
