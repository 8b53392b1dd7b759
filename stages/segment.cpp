// SPDX-License-Identifier: Apache-2.0
#include "stages/segment.h"

#include "stages/chart_topology.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <queue>
#include <set>
#include <tuple>
#include <utility>

namespace vitrine {
namespace {

constexpr double kMaxDeviation =
    0.3;  ///< 1 - length of the mean normal of a merged chart: 0 is flat, a half cylinder has 0.36
constexpr double kRoundness = 0.1;  ///< weight of the outline's roundness against the deviation of normals

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

/// Merges charts two by two, those whose union is flattest and roundest first.
class Merger {
 public:
  Merger(TriMesh const& mesh, FaceAdjacency const& adjacency, Geometry const& geometry,
         std::vector<std::uint32_t>& face_charts, std::uint32_t count, std::size_t min_faces)
      : mesh_(mesh), geometry_(geometry), face_charts_(face_charts), min_faces_(min_faces), charts_(count) {
    auto const faces = faces_of_charts(face_charts, count);
    for (std::uint32_t c = 0; c < count; ++c) {
      charts_[c].faces = faces[c];
      for (std::uint32_t f : faces[c]) {
        charts_[c].area += geometry.area_normal[f].length();
        charts_[c].area_normal += geometry.area_normal[f];
        for (std::size_t i = 0; i < 3; ++i) {
          std::uint32_t const other = adjacency.across[f][i];
          if (other != kNone && face_charts[other] == c) continue;
          charts_[c].perimeter += geometry.edge_length[f][i];
          if (other != kNone) charts_[c].shared[face_charts[other]] += geometry.edge_length[f][i];
        }
      }
    }
  }

  void run() {
    for (std::uint32_t a = 0; a < charts_.size(); ++a)
      for (auto const& [b, length] : charts_[a].shared)
        if (a < b) propose(a, b);
    while (!queue_.empty()) {
      Proposal const p = queue_.top();
      queue_.pop();
      if (charts_[p.a].version == p.version_a && charts_[p.b].version == p.version_b && union_is_disk(p.a, p.b)) {
        merge(p.a, p.b);
        for (auto const& [other, length] : charts_[p.a].shared) propose(p.a, other);
      }
    }
  }

 private:
  struct Chart {
    std::vector<std::uint32_t> faces;
    std::map<std::uint32_t, double> shared;  ///< neighbouring chart -> length of the common seam
    V3d area_normal{0, 0, 0};
    double area = 0, perimeter = 0;
    std::uint32_t version = 0;  ///< counts changes; proposals about an older one are void
  };
  struct Proposal {
    double cost;
    std::uint32_t a, b, version_a, version_b;
    bool operator<(Proposal const& other) const {
      return std::tie(other.cost, other.a, other.b) < std::tie(cost, a, b);
    }
  };

  void propose(std::uint32_t a, std::uint32_t b) {
    if (a > b) std::swap(a, b);
    Chart const &x = charts_[a], &y = charts_[b];
    double const area = x.area + y.area;
    double const deviation = area > 0 ? 1 - (x.area_normal + y.area_normal).length() / area : 0;
    bool const tiny = std::min(x.faces.size(), y.faces.size()) < min_faces_;
    if (deviation > (tiny ? 2 : 1) * kMaxDeviation) return;
    double const perimeter = x.perimeter + y.perimeter - 2 * x.shared.at(b);
    double const roundness = area > 0 ? perimeter / std::sqrt(4 * std::numbers::pi * area) - 1 : 0;
    queue_.push({deviation + kRoundness * roundness, a, b, x.version, y.version});
  }

  bool union_is_disk(std::uint32_t a, std::uint32_t b) const {
    std::vector<Triangle> triangles;
    for (std::uint32_t c : {a, b})
      for (std::uint32_t f : charts_[c].faces) triangles.push_back(mesh_.triangles[f]);
    return disk_defect(triangles).empty();
  }

  void merge(std::uint32_t a, std::uint32_t b) {
    Chart &into = charts_[a], &from = charts_[b];
    for (std::uint32_t f : from.faces) face_charts_[f] = a;
    into.faces.insert(into.faces.end(), from.faces.begin(), from.faces.end());
    into.perimeter += from.perimeter - 2 * into.shared.at(b);
    into.area += from.area;
    into.area_normal += from.area_normal;
    into.shared.erase(b);
    from.shared.erase(a);
    for (auto const& [other, length] : from.shared) {
      into.shared[other] += length;
      charts_[other].shared.erase(b);
      charts_[other].shared[a] = into.shared[other];
    }
    ++into.version;
    from.faces.clear();
    from.shared.clear();
    ++from.version;
  }

  TriMesh const& mesh_;
  Geometry const& geometry_;
  std::vector<std::uint32_t>& face_charts_;
  std::size_t min_faces_;
  std::vector<Chart> charts_;
  std::priority_queue<Proposal> queue_;
};

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
  std::uint32_t const grown =
      grow_disks(mesh, adjacency, local_maxima(adjacency, distance), distance, result.face_charts);
  Merger(mesh, adjacency, geometry, result.face_charts, grown, std::size_t(options.min_chart_faces)).run();
  result.charts = renumber(result.face_charts);
  return result;
}

}  // namespace vitrine
