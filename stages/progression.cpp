// SPDX-License-Identifier: Apache-2.0
#include "stages/progression.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace vitrine {
namespace {

using Index = CollapseMesh::Index;
constexpr Index kNone = CollapseMesh::kNone;

/// Each vertex after the first `count` steps: itself, or the one that it has become.
std::vector<Index> merged(std::vector<CollapseStep> const& steps, std::size_t count, std::size_t vertices) {
  std::vector<Index> now(vertices);
  std::iota(now.begin(), now.end(), Index{0});
  for (std::size_t s = count; s-- > 0;) now[steps[s].from] = now[steps[s].into];
  return now;
}

/// Drops the vertices that no face uses; the others keep their order.
void compact(TriMesh& mesh) {
  std::vector<Index> number(mesh.positions.size(), kNone);
  for (Triangle const& t : mesh.triangles)
    for (Index v : t) number[v] = 0;
  Index next = 0;
  for (std::size_t v = 0; v < number.size(); ++v)
    if (number[v] != kNone) {
      mesh.positions[next] = mesh.positions[v];
      number[v] = next++;
    }
  mesh.positions.resize(next);
  for (Triangle& t : mesh.triangles)
    for (Index& v : t) v = number[v];
}

/// The place of a number in a sorted list.
Index place_in(std::vector<Index> const& sorted, Index number) {
  return Index(std::lower_bound(sorted.begin(), sorted.end(), number) - sorted.begin());
}

}  // namespace

Progression::Progression(TriMesh const& mesh, SimplifyOptions const& options, VertexColours const& colours) {
  if (colours.weight > 0)
    collapse<ColourQuadric>(mesh, options, colours);
  else
    collapse<Quadric>(mesh, options, {});
}

template <class Q>
void Progression::collapse(TriMesh const& mesh, SimplifyOptions const& options, VertexColours const& colours) {
  Collapser<Q> collapser(mesh, options.max_error, colours);
  collapser.reduce_to(kFinest);
  mesh_ = collapser.mesh().extract();
  error_ = collapser.error();
  std::vector<Index> const vertices = collapser.mesh().used_vertices(), faces = collapser.mesh().alive_faces();
  std::vector<std::pair<Index, Index>> went;
  collapser.record(&steps_, &went);
  collapser.reduce_to(1);
  stop_ = collapser.stop(1);
  for (CollapseStep& step : steps_) {
    step.into = place_in(vertices, step.into);
    step.from = place_in(vertices, step.from);
  }
  went_.assign(faces.size(), kStays);
  for (auto const& [face, step] : went) went_[place_in(faces, face)] = step;
}

SimplifiedMesh Progression::at(std::size_t triangles) const {
  if (mesh_.triangles.size() <= triangles) return {mesh_, error_, StopReason::target_reached};
  auto const last = std::partition_point(steps_.begin(), steps_.end(),
                                         [&](CollapseStep const& step) { return step.faces > triangles; });
  bool const reached = last != steps_.end();
  std::size_t const count = std::size_t(last - steps_.begin()) + reached;
  std::vector<Index> const now = merged(steps_, count, mesh_.positions.size());
  SimplifiedMesh level{{mesh_.positions, {}},
                       count > 0 ? steps_[count - 1].error : error_,
                       reached ? StopReason::target_reached : stop_};
  for (std::size_t s = 0; s < count; ++s) level.mesh.positions[steps_[s].into] = steps_[s].place;
  for (std::size_t f = 0; f < mesh_.triangles.size(); ++f)
    if (went_[f] >= count) {
      auto const [a, b, c] = mesh_.triangles[f];
      level.mesh.triangles.push_back({now[a], now[b], now[c]});
    }
  compact(level.mesh);
  return level;
}

}  // namespace vitrine
