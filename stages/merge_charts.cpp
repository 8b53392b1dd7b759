// SPDX-License-Identifier: Apache-2.0
#include "stages/merge_charts.h"

#include "stages/flatten.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <queue>
#include <tuple>
#include <utility>

namespace vitrine {
namespace {
constexpr double kLongest = 1.5;  ///< of a chart, as a share of the side of a square that all charts would fill

template <class T>
void sort_unique(std::vector<T>& values) {
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

template <class T>
std::vector<T> united(std::vector<T> const& a, std::vector<T> const& b) {
  std::vector<T> both;
  std::ranges::set_union(a, b, std::back_inserter(both));
  return both;
}

template <class T>
std::size_t count_common(std::vector<T> const& a, std::vector<T> const& b) {
  std::size_t common = 0;
  for (auto i = a.begin(), j = b.begin(); i != a.end() && j != b.end();) {
    if (*i == *j) ++common;
    *i < *j ? ++i : ++j;
  }
  return common;
}

class Merger {
 public:
  Merger(TriMesh const& mesh, FaceAdjacency const& adjacency, std::size_t min_faces, std::uint32_t first,
         std::vector<std::uint32_t>& face_charts)
      : mesh_(mesh), face_charts_(face_charts), min_faces_(min_faces), first_(first) {
    charts_.resize(std::size_t{*std::ranges::max_element(face_charts)} + 1);
    for (std::uint32_t f = 0; f < face_charts.size(); ++f) {
      Triangle const& t = mesh.triangles[f];
      std::array<V3d, 3> const p{V3d(mesh.positions[t[0]]), V3d(mesh.positions[t[1]]), V3d(mesh.positions[t[2]])};
      double const area = (p[1] - p[0]).cross(p[2] - p[0]).length() / 2;
      Chart& chart = charts_[face_charts[f]];
      chart.faces.push_back(f);
      chart.area += area;
      total_area_ += area;
      for (std::size_t i = 0; i < 3; ++i) {
        auto const [low, high] = std::minmax(t[i], t[(i + 1) % 3]);
        chart.vertices.push_back(t[i]);
        chart.edges.push_back(std::uint64_t{low} << 32 | high);
        std::uint32_t const other = adjacency.across[f][i] == kNone ? kNone : face_charts[adjacency.across[f][i]];
        if (other == face_charts[f]) continue;
        double const length = (p[(i + 1) % 3] - p[i]).length();
        chart.perimeter += length;
        if (other == kNone) continue;
        chart.seams[other].length += length;
        ++chart.seams[other].edges;
      }
    }
    for (Chart& chart : charts_) {
      sort_unique(chart.vertices);
      sort_unique(chart.edges);
    }
  }

  void run() {
    for (std::uint32_t a = 0; a < charts_.size(); ++a)
      for (auto const& [b, seam] : charts_[a].seams)
        if (a < b) propose(a, b, seam);
    while (!queue_.empty()) {
      Proposal const p = queue_.top();
      queue_.pop();
      if (!current(p) || !may_merge(charts_[p.a], charts_[p.b], charts_[p.a].seams.at(p.b))) continue;
      merge(p.a, p.b);
      for (auto const& [other, seam] : charts_[p.a].seams) propose(p.a, other, seam);
    }
  }

 private:
  struct Seam {
    double length = 0;
    std::size_t edges = 0;
  };
  struct Chart {
    std::vector<std::uint32_t> faces;
    std::vector<std::uint32_t> vertices;  ///< ascending
    std::vector<std::uint64_t> edges;     ///< lower vertex, then higher one; ascending
    std::map<std::uint32_t, Seam> seams;  ///< neighbouring chart -> the common seam
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
  /// Small charts with a long common seam first: what is left are few charts of like size and round shape.
  void propose(std::uint32_t a, std::uint32_t b, Seam const& seam) {
    if (a > b) std::swap(a, b);
    if (b < first_) return;
    Chart const &x = charts_[a], &y = charts_[b];
    double const size = total_area_ > 0 ? std::sqrt(std::min(x.area, y.area) / total_area_) : 0;
    double const perimeter = std::min(x.perimeter, y.perimeter), enclosed = perimeter > 0 ? seam.length / perimeter : 1;
    queue_.push({size - enclosed, a, b, x.version, y.version});
  }

  bool current(Proposal const& p) const {
    return charts_[p.a].version == p.version_a && charts_[p.b].version == p.version_b;
  }

  bool may_merge(Chart const& x, Chart const& y, Seam const& seam) const {
    if (!union_is_disk(x, y, seam)) return false;
    std::vector<std::uint32_t> faces = x.faces;
    faces.insert(faces.end(), y.faces.begin(), y.faces.end());
    FlatDisk const flat = flatten(submesh(mesh_, faces));
    bool const tiny = std::min(x.faces.size(), y.faces.size()) < min_faces_;
    return flat.length <= kLongest * std::sqrt(total_area_) && lies_flat(flat, tiny ? kBearable : kEasyToUnfold);
  }

  /// Two disks make a disk if what they share is one path, all of it a seam between neighbouring faces.
  static bool union_is_disk(Chart const& x, Chart const& y, Seam const& seam) {
    std::size_t const edges = count_common(x.edges, y.edges);
    return edges == seam.edges && count_common(x.vertices, y.vertices) == edges + 1;
  }

  void merge(std::uint32_t a, std::uint32_t b) {
    Chart &into = charts_[a], &from = charts_[b];
    for (std::uint32_t f : from.faces) face_charts_[f] = a;
    into.vertices = united(into.vertices, from.vertices);
    into.edges = united(into.edges, from.edges);
    into.faces.insert(into.faces.end(), from.faces.begin(), from.faces.end());
    into.perimeter += from.perimeter - 2 * into.seams.at(b).length;
    into.area += from.area;
    into.seams.erase(b);
    from.seams.erase(a);
    for (auto const& [other, seam] : from.seams) {
      into.seams[other].length += seam.length;
      into.seams[other].edges += seam.edges;
      charts_[other].seams.erase(b);
      charts_[other].seams[a] = into.seams[other];
    }
    from.faces.clear();
    from.seams.clear();
    ++into.version;
    ++from.version;
  }

  TriMesh const& mesh_;
  std::vector<std::uint32_t>& face_charts_;
  std::size_t min_faces_;
  std::uint32_t first_;
  std::vector<Chart> charts_;
  double total_area_ = 0;
  std::priority_queue<Proposal> queue_;
};

}  // namespace

void merge_charts(TriMesh const& mesh, FaceAdjacency const& adjacency, std::size_t min_faces, std::uint32_t first,
                  std::vector<std::uint32_t>& face_charts) {
  if (!face_charts.empty()) Merger(mesh, adjacency, min_faces, first, face_charts).run();
}

}  // namespace vitrine
