// SPDX-License-Identifier: Apache-2.0
#include "stages/segment.h"

#include "stages/chart_topology.h"
#include "stages/flatten.h"
#include "stages/merge_charts.h"
#include "stages/straighten.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <queue>
#include <tuple>
#include <utility>

namespace vitrine {
namespace {

struct Geometry {
  std::vector<V3d> area_normal;                    ///< f, length = area
  std::vector<V3d> centroid;                       ///< f
  std::vector<std::array<double, 3>> edge_length;  ///< f, of the edge from corner i to corner i + 1
};

Geometry measure(TriMesh const& mesh) {
  Geometry g;
  for (Triangle const& t : mesh.triangles) {
    std::array<V3d, 3> const p{V3d(mesh.positions[t[0]]), V3d(mesh.positions[t[1]]), V3d(mesh.positions[t[2]])};
    g.area_normal.push_back((p[1] - p[0]).cross(p[2] - p[0]) / 2);
    g.centroid.push_back((p[0] + p[1] + p[2]) / 3);
    g.edge_length.push_back({(p[1] - p[0]).length(), (p[2] - p[1]).length(), (p[0] - p[2]).length()});
  }
  return g;
}

/// Whether each edge of each face is a feature: an open border, or among the sharpest `share` of the others.
std::vector<std::array<bool, 3>> feature_edges(FaceAdjacency const& adjacency, Geometry const& g, double share) {
  std::vector<std::tuple<double, std::uint32_t, std::uint32_t>> inner;  // -angle's cosine first: the sharpest last
  std::vector<std::array<bool, 3>> feature(adjacency.across.size(), {false, false, false});
  for (std::uint32_t f = 0; f < feature.size(); ++f)
    for (std::uint32_t i = 0; i < 3; ++i) {
      std::uint32_t const other = adjacency.across[f][i];
      if (other == kNone) feature[f][i] = true;
      if (other != kNone && f < other)
        inner.emplace_back(g.area_normal[f].normalized().dot(g.area_normal[other].normalized()), f, i);
    }
  std::ranges::sort(inner);
  inner.resize(std::size_t(std::ceil(share * double(inner.size()))));
  for (auto const& [cosine, f, i] : inner) {
    if (cosine > 1 - 1e-6) break;  // flat: no feature, however few are sharper
    std::uint32_t const other = adjacency.across[f][i];
    feature[f][i] = true;
    for (std::uint32_t j = 0; j < 3; ++j)
      if (adjacency.across[other][j] == f) feature[other][j] = true;
  }
  return feature;
}

/// Distance of each face from the nearest feature, along centroids; 0 everywhere on a component that has none.
std::vector<double> distance_to_features(TriMesh const& mesh, FaceAdjacency const& adjacency, Geometry const& g,
                                         std::vector<std::array<bool, 3>> const& feature) {
  using Entry = std::pair<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  std::vector<double> distance(feature.size(), std::numeric_limits<double>::infinity());
  auto const reach = [&](std::uint32_t f, double d) {
    if (d < distance[f]) queue.emplace(distance[f] = d, f);
  };
  for (std::uint32_t f = 0; f < feature.size(); ++f)
    for (std::size_t i = 0; i < 3; ++i)
      if (feature[f][i]) {
        Triangle const& t = mesh.triangles[f];
        V3d const middle = (V3d(mesh.positions[t[i]]) + V3d(mesh.positions[t[(i + 1) % 3]])) / 2;
        reach(f, (g.centroid[f] - middle).length());
      }
  while (!queue.empty()) {
    auto const [d, f] = queue.top();
    queue.pop();
    if (d > distance[f]) continue;
    for (std::uint32_t other : adjacency.across[f])
      if (other != kNone) reach(other, d + (g.centroid[other] - g.centroid[f]).length());
  }
  for (double& d : distance)
    if (std::isinf(d)) d = 0;
  return distance;
}

/// Faces farther from the features than all their neighbours; ties by index.
std::vector<std::uint32_t> local_maxima(FaceAdjacency const& adjacency, std::vector<double> const& distance) {
  std::vector<std::uint32_t> maxima;
  for (std::uint32_t f = 0; f < distance.size(); ++f)
    if (std::ranges::all_of(adjacency.across[f], [&](std::uint32_t other) {
          return other == kNone || std::pair(distance[other], f) < std::pair(distance[f], other);
        }))
      maxima.push_back(f);
  return maxima;
}

/// Cuts charts that do not lie flat until each of them does; a single face always does.
void cut_folded(TriMesh const& mesh, std::vector<std::uint32_t>& face_charts, std::uint32_t& charts) {
  std::vector<std::vector<std::uint32_t>> waiting = faces_of_charts(face_charts, charts);
  while (!waiting.empty()) {
    std::vector<std::uint32_t> const faces = std::move(waiting.back());
    waiting.pop_back();
    if (faces.size() < 2) continue;
    TriMesh const disk = submesh(mesh, faces);
    if (lies_flat(flatten(disk), kEasyToUnfold)) continue;
    std::vector<std::vector<std::uint32_t>> parts = cut_disk(disk);
    for (std::size_t p = 0; p < parts.size(); ++p) {
      std::uint32_t const chart = p == 0 ? face_charts[faces[0]] : charts++;
      for (std::uint32_t& f : parts[p]) {
        f = faces[f];
        face_charts[f] = chart;
      }
      waiting.push_back(std::move(parts[p]));
    }
  }
}

/// Numbers the charts in use from 0, in the order of their first faces; returns how many there are.
std::uint32_t renumber(std::vector<std::uint32_t>& face_charts) {
  std::map<std::uint32_t, std::uint32_t> number;
  for (std::uint32_t& c : face_charts) c = number.try_emplace(c, std::uint32_t(number.size())).first->second;
  return std::uint32_t(number.size());
}

}  // namespace

ChartedMesh segment(TriMesh const& mesh, SegmentOptions const& options) {
  ChartedMesh result;
  result.mesh = mesh;
  FaceAdjacency const adjacency = face_adjacency(mesh);
  Geometry const geometry = measure(mesh);
  auto const features = feature_edges(adjacency, geometry, options.feature_share);
  std::vector<double> const distance = distance_to_features(mesh, adjacency, geometry, features);
  auto const merge = [&, small = std::size_t(options.min_chart_faces)](std::uint32_t first) {
    merge_charts(mesh, adjacency, small, first, result.face_charts);
  };
  result.charts = grow_disks(mesh, adjacency, local_maxima(adjacency, distance), distance, result.face_charts);
  straighten(mesh, adjacency, result.face_charts);
  cut_folded(mesh, result.face_charts, result.charts);
  merge(0);

  std::uint32_t const merged =
      result.charts;  // straight seams may fold a chart: what is cut off looks for a place again
  straighten(mesh, adjacency, result.face_charts);
  cut_folded(mesh, result.face_charts, result.charts);
  merge(merged);
  result.charts = renumber(result.face_charts);
  return result;
}

}  // namespace vitrine
