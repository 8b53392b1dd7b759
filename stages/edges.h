// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The edges of a welded mesh, and those where it ends.

#include "stages/data.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace vitrine {

/// An edge as one of its faces has it: from one corner to the next.
struct FaceEdge {
  std::uint32_t face;
  std::uint32_t corner;
};

inline std::array<std::uint32_t, 2> ends(TriMesh const& mesh, FaceEdge const& edge) {
  Triangle const& t = mesh.triangles[edge.face];
  return {t[edge.corner], t[(edge.corner + 1) % 3]};
}

/// Calls visit(std::span<FaceEdge const>) with each edge as all of its faces have it, faces ascending; edges come by
/// their lower, then by their higher vertex. Linear in the faces; 28 bytes a face while it runs.
template <class Visit>
void for_edges(TriMesh const& mesh, Visit const& visit) {
  struct Side {
    std::uint32_t higher;
    FaceEdge edge;
  };
  std::vector<std::uint32_t> first(mesh.positions.size() + 1, 0);
  for (Triangle const& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++first[std::min(t[k], t[(k + 1) % 3])];
  std::uint32_t sum = 0;
  for (std::uint32_t& f : first) f = sum += f;
  std::vector<Side> sides(sum);
  for (std::size_t f = mesh.triangles.size(); f-- > 0;)
    for (std::uint32_t k = 0; k < 3; ++k) {
      FaceEdge const edge{std::uint32_t(f), k};
      auto const [a, b] = ends(mesh, edge);
      sides[--first[std::min(a, b)]] = {std::max(a, b), edge};
    }
  std::vector<FaceEdge> edge;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    auto const begin = sides.begin() + first[v], end = sides.begin() + first[v + 1];
    std::stable_sort(begin, end, [](Side const& a, Side const& b) { return a.higher < b.higher; });
    for (auto at = begin; at != end;) {
      edge.clear();
      for (std::uint32_t const higher = at->higher; at != end && at->higher == higher; ++at) edge.push_back(at->edge);
      visit(std::span<FaceEdge const>(edge));
    }
  }
}

struct Outline {
  std::vector<FaceEdge> open;     ///< edges with one face
  std::vector<FaceEdge> tangled;  ///< edges with more than two faces, one entry per face
};

Outline outline(TriMesh const& mesh);

}  // namespace vitrine
