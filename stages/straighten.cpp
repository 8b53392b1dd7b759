// SPDX-License-Identifier: Apache-2.0
#include "stages/straighten.h"

#include <algorithm>
#include <deque>

namespace vitrine {
namespace {

class Straightener {
 public:
  Straightener(TriMesh const& mesh, FaceAdjacency const& adjacency, std::vector<std::uint32_t>& face_charts)
      : mesh_(mesh), adjacency_(adjacency), face_charts_(face_charts), waiting_(face_charts.size(), true) {}

  void run() {
    for (std::uint32_t f = 0; f < waiting_.size(); ++f) queue_.push_back(f);
    while (!queue_.empty()) {
      std::uint32_t const f = queue_.front();
      queue_.pop_front();
      waiting_[f] = false;
      for (std::uint32_t i = 0; i < 3; ++i)
        if (move_face(f, i) || move_pair(f, i)) break;
    }
  }

 private:
  std::uint32_t across(std::uint32_t f, std::uint32_t i) const { return adjacency_.across[f][i % 3]; }
  std::uint32_t chart_across(std::uint32_t f, std::uint32_t i) const {
    return across(f, i) == kNone ? kNone : face_charts_[across(f, i)];
  }
  double length(std::uint32_t a, std::uint32_t b) const {
    return (V3d(mesh_.positions[a]) - V3d(mesh_.positions[b])).length();
  }

  void assign(std::uint32_t f, std::uint32_t chart) {
    face_charts_[f] = chart;
    for (std::uint32_t v : mesh_.triangles[f])
      for (std::uint32_t other : adjacency_.around(v))
        if (!waiting_[other]) {
          waiting_[other] = true;
          queue_.push_back(other);
        }
  }

  /// Gives f to the chart behind its edges i and i + 1 if its third edge alone holds it to its own.
  bool move_face(std::uint32_t f, std::uint32_t i) {
    std::uint32_t const own = face_charts_[f], other = chart_across(f, i);
    if (other == kNone || other == own || chart_across(f, i + 1) != other || chart_across(f, i + 2) != own)
      return false;
    if (!keeps_disk(mesh_, adjacency_, face_charts_, f, other)) return false;
    assign(f, other);
    return true;
  }

  /// Edge i of f runs u-v along a seam. If f and the face behind its edge v-x are all that its chart has at v, the seam
  /// u-v-w may as well run u-x-w.
  bool move_pair(std::uint32_t f, std::uint32_t i) {
    std::uint32_t const own = face_charts_[f], other = chart_across(f, i), g = across(f, i + 1);
    if (other == kNone || other == own || g == kNone || face_charts_[g] != own) return false;
    std::uint32_t const u = mesh_.triangles[f][i % 3], v = mesh_.triangles[f][(i + 1) % 3],
                        x = mesh_.triangles[f][(i + 2) % 3];
    std::uint32_t k = 0;  // corner of g at v: g runs x, v, w there
    while (mesh_.triangles[g][k] != v) ++k;
    std::uint32_t const w = mesh_.triangles[g][(k + 1) % 3];
    if (chart_across(g, k) != other || length(u, x) + length(x, w) >= length(u, v) + length(v, w)) return false;
    if (!interior(x, own)) return false;
    if (!keeps_disk(mesh_, adjacency_, face_charts_, f, other)) return false;
    face_charts_[f] = other;
    bool const disk = keeps_disk(mesh_, adjacency_, face_charts_, g, other);
    face_charts_[f] = own;
    if (!disk) return false;
    assign(f, other);
    assign(g, other);
    return true;
  }

  /// Whether the chart surrounds the vertex, so that it stays a disk without two neighbouring faces there.
  bool interior(std::uint32_t vertex, std::uint32_t chart) const {
    return std::ranges::all_of(adjacency_.around(vertex), [&](std::uint32_t f) {
      for (std::uint32_t i = 0; i < 3; ++i)
        if ((mesh_.triangles[f][i] == vertex || mesh_.triangles[f][(i + 1) % 3] == vertex) &&
            chart_across(f, i) != chart)
          return false;
      return face_charts_[f] == chart;
    });
  }

  TriMesh const& mesh_;
  FaceAdjacency const& adjacency_;
  std::vector<std::uint32_t>& face_charts_;
  std::vector<bool> waiting_;
  std::deque<std::uint32_t> queue_;
};

}  // namespace

void straighten(TriMesh const& mesh, FaceAdjacency const& adjacency, std::vector<std::uint32_t>& face_charts) {
  Straightener(mesh, adjacency, face_charts).run();
}

}  // namespace vitrine
