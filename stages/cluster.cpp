// SPDX-License-Identifier: Apache-2.0
#include "stages/cluster.h"

#include "stages/clean.h"
#include "stages/parallel.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

namespace vitrine {
namespace {

using Index = std::uint32_t;

constexpr std::size_t kGrain = std::size_t{1} << 15;
constexpr std::size_t kChunks = 4;  ///< of sums over vertices: their number must not depend on the machine
constexpr std::size_t kSampledFaces = 400'000;
constexpr double kCellsPerArea = 1.5;  ///< cells of edge 1 that a surface of area 1 crosses, over all directions

bool has_place(V3f const& p) { return std::abs(p.x) < 1e18f && std::abs(p.y) < 1e18f && std::abs(p.z) < 1e18f; }

Box3f box_of(std::vector<V3f> const& positions) {
  return parallel_reduce(
      positions.size(), kGrain, Box3f(),
      [&](std::size_t begin, std::size_t end) {
        Box3f box;
        for (std::size_t v = begin; v < end; ++v)
          if (has_place(positions[v])) box.extendBy(positions[v]);
        return box;
      },
      [](Box3f total, Box3f const& part) {
        total.extendBy(part);
        return total;
      });
}

/// By some of the faces.
double estimated_area(TriMesh const& mesh) {
  std::size_t const step = std::max<std::size_t>(1, mesh.triangles.size() / kSampledFaces);
  double sum = 0;
  for (std::size_t f = 0; f < mesh.triangles.size(); f += step) {
    auto const& [a, b, c] = mesh.triangles[f];
    V3d const p(mesh.positions[a]);
    double const area = (V3d(mesh.positions[b]) - p).cross(V3d(mesh.positions[c]) - p).length() / 2;
    if (std::isfinite(area)) sum += area;
  }
  return sum * double(step);
}

/// A number for each cell of a grid. Two cells may share one: then neighbours become one that need not, and nothing
/// else.
class Cells {
 public:
  Cells(V3f const& origin, double edge) : origin_(origin), scale_(float(1 / edge)) {}

  Index operator()(V3f const& p) const {
    if (!has_place(p)) return 0;
    V3f const cell = (p - origin_) * scale_;
    std::uint64_t key = 0;
    for (int k = 0; k < 3; ++k) key = (key + std::uint64_t(cell[k])) * 0x9e3779b97f4a7c15u;
    return Index(key >> 32);
  }

 private:
  V3f origin_;
  float scale_;
};

/// Sets of vertices; each is known by its first one. Calls may come from any thread, and their order does not matter.
class Sets {
 public:
  explicit Sets(std::vector<Index> first) : first_(std::move(first)) {}

  void unite(Index a, Index b) {
    for (;;) {
      a = find(a), b = find(b);
      if (a == b) return;
      if (a < b) std::swap(a, b);
      Index expected = a;
      if (at(a).compare_exchange_strong(expected, b, std::memory_order_relaxed)) return;
    }
  }

  Index find(Index v) {
    for (;;) {
      Index const up = at(v).load(std::memory_order_relaxed), top = at(up).load(std::memory_order_relaxed);
      if (up == top) return up;
      at(v).store(top, std::memory_order_relaxed);  // never beyond the first one: halves the way for others
      v = top;
    }
  }

 private:
  std::atomic_ref<Index> at(Index v) { return std::atomic_ref(first_[v]); }

  std::vector<Index> first_;
};

struct Clusters {
  std::vector<Index> of;  ///< per vertex
  std::size_t count = 0;
};

Clusters find_clusters(TriMesh const& mesh, Cells const& cells) {
  std::vector<Index> cell(mesh.positions.size());
  parallel_for(cell.size(), kGrain, [&](std::size_t v) { cell[v] = cells(mesh.positions[v]); });
  Sets sets(merged_places(mesh));
  parallel_for(mesh.triangles.size(), kGrain, [&](std::size_t f) {
    auto const& [a, b, c] = mesh.triangles[f];
    if (cell[a] == cell[b]) sets.unite(a, b);
    if (cell[b] == cell[c]) sets.unite(b, c);
    if (cell[c] == cell[a]) sets.unite(c, a);
  });
  Clusters clusters{std::move(cell), 0};
  parallel_for(clusters.of.size(), kGrain, [&](std::size_t v) { clusters.of[v] = sets.find(Index(v)); });
  std::vector<Index> number(clusters.of.size());
  for (std::size_t v = 0; v < number.size(); ++v)
    if (clusters.of[v] == v) number[v] = Index(clusters.count++);
  parallel_for(number.size(), kGrain, [&](std::size_t v) { clusters.of[v] = number[clusters.of[v]]; });
  return clusters;
}

/// Per cluster the mean of `value(vertex)`, in double.
template <class Value>
auto means(Clusters const& clusters, Value const& value) {
  using Mean = decltype(value(0));
  using Sum = std::pair<Mean, std::uint32_t>;
  std::size_t const vertices = clusters.of.size(), chunk = (vertices + kChunks - 1) / kChunks;
  std::array<std::vector<Sum>, kChunks> sums;
  parallel_for(kChunks, 1, [&](std::size_t k) {
    sums[k].assign(clusters.count, {Mean(0), 0});
    for (std::size_t v = k * chunk; v < std::min(vertices, (k + 1) * chunk); ++v) {
      auto& [sum, count] = sums[k][clusters.of[v]];
      sum += value(v), ++count;
    }
  });
  std::vector<Mean> result(clusters.count);
  parallel_for(clusters.count, kGrain, [&](std::size_t c) {
    Sum all = sums[0][c];
    for (std::size_t k = 1; k < kChunks; ++k) all.first += sums[k][c].first, all.second += sums[k][c].second;
    result[c] = all.first / double(all.second);
  });
  return result;
}

V3d as_double(V3f const& v) { return V3d(v); }

/// Faces whose corners lie in three clusters, in order.
std::vector<Triangle> faces_between(std::vector<Triangle> const& triangles, Clusters const& clusters) {
  constexpr std::size_t block = std::size_t{1} << 18;
  std::vector<std::vector<Triangle>> kept((triangles.size() + block - 1) / block);
  parallel_blocks(triangles.size(), block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      Triangle const t{clusters.of[triangles[f][0]], clusters.of[triangles[f][1]], clusters.of[triangles[f][2]]};
      if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) kept[begin / block].push_back(t);
    }
  });
  std::vector<Triangle> all;
  for (std::vector<Triangle> const& part : kept) all.insert(all.end(), part.begin(), part.end());
  return all;
}

Rgba16 rounded(Imath::Vec4<double> const& colour) {
  Rgba16 out;
  for (int k = 0; k < 4; ++k) out[k] = static_cast<std::uint16_t>(std::lround(colour[k]));
  return out;
}

}  // namespace

std::optional<SourceModel> cluster(SourceModel const& source, ClusterOptions const& options) {
  TriMesh const& mesh = source.mesh;
  if (mesh.triangles.size() <= std::size_t(options.above) || !source.images.empty() || !source.face_materials.empty())
    return {};
  double const area = estimated_area(mesh), edge = std::sqrt(2 * kCellsPerArea * area / options.triangles);
  Box3f const box = box_of(mesh.positions);
  if (!(edge > 0) || !(double(box.size().length()) / edge < 1e6)) return {};
  Clusters const clusters = find_clusters(mesh, Cells(box.min, edge));

  SourceModel thin;
  thin.mesh.triangles = faces_between(mesh.triangles, clusters);
  if (thin.mesh.triangles.size() < std::size_t(options.triangles) / 10) return {};
  for (V3d const& p : means(clusters, [&](std::size_t v) { return as_double(mesh.positions[v]); }))
    thin.mesh.positions.emplace_back(p);
  if (!source.normals.empty())
    for (V3d const& n : means(clusters, [&](std::size_t v) { return as_double(source.normals[v]); }))
      thin.normals.emplace_back(n);
  if (!source.colours.empty())
    for (auto const& colour : means(clusters, [&](std::size_t v) {
           Rgba16 const& c = source.colours[v];
           return Imath::Vec4<double>(c[0], c[1], c[2], c[3]);
         }))
      thin.colours.push_back(rounded(colour));
  thin.origin = source.origin;
  thin.materials = source.materials;
  thin.notes = source.notes;
  return thin;
}

}  // namespace vitrine
