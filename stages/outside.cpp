// SPDX-License-Identifier: Apache-2.0
#include "stages/outside.h"

#include "stages/clean.h"
#include "stages/depth_buffer.h"
#include "stages/parallel.h"
#include "stages/union_find.h"
#include "stages/view.h"

#include <algorithm>
#include <atomic>

namespace vitrine {
namespace {

constexpr std::size_t kTangled = 3;  ///< faces a vertex, where surfaces have two
constexpr double kOneShell = 0.75;   ///< of the faces: what holds so many is the object, and the rest trimmings
constexpr double kMostHidden = 0.3;  ///< of the faces
constexpr int kViews = 64, kSize = 600;

/// Bytes, as threads may set neighbours at once.
using Marks = std::vector<std::uint8_t>;

void mark_seen(DepthBuffer const& buffer, Marks& seen) {
  for (int row = buffer.top(); row <= buffer.bottom(); ++row)
    for (int column = buffer.left(); column <= buffer.right(); ++column)
      if (std::uint32_t const face = buffer.face(column, row); face != DepthBuffer::kNothing)
        std::atomic_ref(seen[face]).store(1, std::memory_order_relaxed);
}

/// Faces that are nearest somewhere; all where a view cannot be drawn.
Marks seen_faces(SourceModel const& model) {
  Marks seen(model.mesh.triangles.size(), 0);
  BoundingSphere const sphere = bounding_sphere(model);
  std::vector<V3d> const from = directions(ViewSet::sphere, kViews);
  std::atomic<bool> drawn = true;
  constexpr std::size_t views_per_buffer = 5;
  parallel_blocks(from.size(), views_per_buffer, [&](std::size_t begin, std::size_t end) {
    DepthBuffer buffer(kSize);
    for (std::size_t view = begin; view < end; ++view)
      if (buffer.draw(model.mesh, Lens(camera(sphere, from[view]), model.origin, kSize)))
        mark_seen(buffer, seen);
      else
        drawn = false;
  });
  if (!drawn) std::fill(seen.begin(), seen.end(), std::uint8_t{1});
  return seen;
}

/// Faces share a vertex only within a shell.
bool has_many_shells(TriMesh const& mesh, std::vector<std::uint32_t> const& places) {
  UnionFind shells(mesh.positions.size());
  for (auto const& [a, b, c] : mesh.triangles) {
    shells.join(places[a], places[b]);
    shells.join(places[b], places[c]);
  }
  std::vector<std::size_t> faces(mesh.positions.size(), 0);
  for (Triangle const& face : mesh.triangles) ++faces[shells.root(places[face[0]])];
  return double(*std::max_element(faces.begin(), faces.end())) < kOneShell * double(mesh.triangles.size());
}

/// Neighbours of what is seen count, too: small faces fall between samples.
void mark_neighbours(TriMesh const& mesh, std::vector<std::uint32_t> const& places, Marks& seen) {
  Marks touched(mesh.positions.size(), 0);
  for (std::size_t f = 0; f < seen.size(); ++f)
    if (seen[f])
      for (std::uint32_t v : mesh.triangles[f]) touched[places[v]] = 1;
  for (std::size_t f = 0; f < seen.size(); ++f)
    for (std::uint32_t v : mesh.triangles[f]) seen[f] |= touched[places[v]];
}

template <class Value>
std::vector<Value> marked(std::vector<Value> const& values, Marks const& marks) {
  std::vector<Value> kept;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (marks[i]) kept.push_back(values[i]);
  return kept;
}

}  // namespace

std::optional<SourceModel> outside(SourceModel const& model) {
  TriMesh const& mesh = model.mesh;
  bool const tangle = mesh.triangles.size() >= kTangled * mesh.positions.size();
  std::vector<std::uint32_t> const places = shared_places(mesh);
  if (!tangle && !has_many_shells(mesh, places)) return {};
  Marks seen = seen_faces(model);
  if (!tangle) mark_neighbours(mesh, places, seen);
  if (double(std::count(seen.begin(), seen.end(), 0)) < kMostHidden * double(seen.size())) return {};
  SourceModel made = model;
  made.mesh.triangles = marked(model.mesh.triangles, seen);
  made.face_materials = marked(model.face_materials, seen);
  return made;
}

}  // namespace vitrine
