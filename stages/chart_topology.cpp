// SPDX-License-Identifier: Apache-2.0
#include "stages/chart_topology.h"

#include "stages/union_find.h"

#include <algorithm>
#include <numeric>
#include <queue>
#include <tuple>

namespace vitrine {
namespace {

/// Corner `corner` of face `face` starts this edge; low < high unless the face repeats a vertex.
struct HalfEdge {
  std::uint32_t low, high, face, corner;
  bool forward;  ///< runs from low to high
};

/// All half-edges, those of one edge in a row.
std::vector<HalfEdge> sorted_half_edges(std::span<Triangle const> triangles) {
  std::vector<HalfEdge> half_edges;
  half_edges.reserve(3 * triangles.size());
  for (std::uint32_t f = 0; f < triangles.size(); ++f)
    for (std::uint32_t i = 0; i < 3; ++i) {
      std::uint32_t const a = triangles[f][i], b = triangles[f][(i + 1) % 3];
      half_edges.push_back({std::min(a, b), std::max(a, b), f, i, a < b});
    }
  std::ranges::sort(half_edges, {}, [](HalfEdge const& h) { return std::tuple(h.low, h.high, h.face, h.corner); });
  return half_edges;
}

/// Calls body with each run of half-edges of one edge.
template <class Body>
void for_each_edge(std::span<HalfEdge const> half_edges, Body const& body) {
  for (std::size_t begin = 0, end = 0; begin < half_edges.size(); begin = end) {
    while (end < half_edges.size() && half_edges[end].low == half_edges[begin].low &&
           half_edges[end].high == half_edges[begin].high)
      ++end;
    body(half_edges.subspan(begin, end - begin));
  }
}

V3d unit_normal(TriMesh const& mesh, std::uint32_t face) {
  auto const [a, b, c] = mesh.triangles[face];
  V3d const p(mesh.positions[a]), q(mesh.positions[b]), r(mesh.positions[c]);
  return (q - p).cross(r - p).normalized();
}

/// More faces than this at one edge are no surface; the limit keeps the pairs of a hostile file few.
constexpr std::size_t kMostFacesAtEdge = 32;

/// Pairs the half-edges of one edge, opposite directions only, flattest first.
template <class Join>
void pair_flattest(TriMesh const& mesh, std::span<HalfEdge const> edge, Join const& join) {
  std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < edge.size(); ++i)
    for (std::size_t j = i + 1; j < edge.size(); ++j)
      if (edge[i].forward != edge[j].forward && edge[i].face != edge[j].face)
        pairs.emplace_back(-unit_normal(mesh, edge[i].face).dot(unit_normal(mesh, edge[j].face)), i, j);
  std::ranges::sort(pairs);
  std::vector<bool> taken(edge.size());
  for (auto const& [bend, i, j] : pairs)
    if (!taken[i] && !taken[j]) {
      taken[i] = taken[j] = true;
      join(edge[i], edge[j]);
    }
}

std::size_t count_vertices(std::span<Triangle const> triangles) {
  std::vector<std::uint32_t> vertices;
  for (Triangle const& t : triangles) vertices.insert(vertices.end(), t.begin(), t.end());
  std::ranges::sort(vertices);
  return std::size_t(std::unique(vertices.begin(), vertices.end()) - vertices.begin());
}

std::string name(HalfEdge const& h) { return std::to_string(h.low) + "-" + std::to_string(h.high); }

/// Steps over edges from `start` to each face.
std::vector<double> steps_from(FaceAdjacency const& adjacency, std::uint32_t start) {
  std::vector<double> steps(adjacency.across.size(), -1);
  std::queue<std::uint32_t> front;
  steps[start] = 0;
  for (front.push(start); !front.empty(); front.pop())
    for (std::uint32_t neighbour : adjacency.across[front.front()])
      if (neighbour != kNone && steps[neighbour] < 0) {
        steps[neighbour] = steps[front.front()] + 1;
        front.push(neighbour);
      }
  return steps;
}

}  // namespace

FaceAdjacency face_adjacency(TriMesh const& mesh) {
  FaceAdjacency adjacency;
  adjacency.across.assign(mesh.triangles.size(), {kNone, kNone, kNone});
  auto const join = [&](HalfEdge const& a, HalfEdge const& b) {
    adjacency.across[a.face][a.corner] = b.face;
    adjacency.across[b.face][b.corner] = a.face;
  };
  for_each_edge(sorted_half_edges(mesh.triangles), [&](std::span<HalfEdge const> edge) {
    if (edge.size() == 2 && edge[0].forward != edge[1].forward && edge[0].face != edge[1].face)
      join(edge[0], edge[1]);
    else if (edge.size() > 2 && edge.size() <= kMostFacesAtEdge)
      pair_flattest(mesh, edge, join);
  });

  adjacency.first.assign(mesh.positions.size() + 1, 0);
  for (Triangle const& t : mesh.triangles)
    for (std::uint32_t v : t) ++adjacency.first[v + 1];
  std::partial_sum(adjacency.first.begin(), adjacency.first.end(), adjacency.first.begin());
  adjacency.faces.resize(3 * mesh.triangles.size());
  std::vector<std::uint32_t> next(adjacency.first.begin(), adjacency.first.end() - 1);
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f)
    for (std::uint32_t v : mesh.triangles[f]) adjacency.faces[next[v]++] = f;
  return adjacency;
}

std::string disk_defect(std::span<Triangle const> triangles) {
  if (triangles.empty()) return "has no face";
  std::string defect;
  std::size_t edges = 0;
  UnionFind pieces(triangles.size()), fans(3 * triangles.size());
  for_each_edge(sorted_half_edges(triangles), [&](std::span<HalfEdge const> edge) {
    ++edges;
    if (edge.size() == 1) return;
    if (edge.size() > 2) {
      defect = "has " + std::to_string(edge.size()) + " faces at edge " + name(edge[0]);
    } else if (edge[0].forward == edge[1].forward || edge[0].face == edge[1].face) {
      defect = "turns over at edge " + name(edge[0]);
    } else {
      HalfEdge const &a = edge[0], &b = edge[1];
      pieces.join(a.face, b.face);
      fans.join(3 * a.face + a.corner, 3 * b.face + (b.corner + 1) % 3);
      fans.join(3 * a.face + (a.corner + 1) % 3, 3 * b.face + b.corner);
    }
  });
  if (!defect.empty()) return defect;
  std::size_t const vertices = count_vertices(triangles);
  if (pieces.sets() != 1) return "falls into " + std::to_string(pieces.sets()) + " pieces";
  if (fans.sets() != vertices) return "touches itself at a vertex";
  long const euler = long(vertices) - long(edges) + long(triangles.size());
  if (euler != 1) return "has Euler characteristic " + std::to_string(euler) + ", a disk has 1";
  return {};
}

bool keeps_disk(TriMesh const& mesh, FaceAdjacency const& adjacency, std::span<std::uint32_t const> face_charts,
                std::uint32_t face, std::uint32_t chart) {
  Triangle const& t = mesh.triangles[face];
  auto const in_chart = [&](std::uint32_t f) { return f != kNone && face_charts[f] == chart; };
  auto const uses = [&](std::uint32_t f, std::uint32_t v) { return std::ranges::count(mesh.triangles[f], v) > 0; };
  int shared = 0;
  for (std::uint32_t i = 0; i < 3; ++i) {
    if (in_chart(adjacency.across[face][i])) {
      ++shared;
      continue;
    }
    for (std::uint32_t f : adjacency.around(t[i]))
      if (f != face && in_chart(f) && uses(f, t[(i + 1) % 3]))
        return false;  // would meet at an edge without being neighbours
  }
  if (shared == 2) return true;  // closes the fan around a boundary vertex
  if (shared != 1) return false;
  for (std::uint32_t i = 0; i < 3; ++i)
    if (in_chart(adjacency.across[face][i]))
      return std::ranges::none_of(adjacency.around(t[(i + 2) % 3]),
                                  in_chart);  // else it would bridge the chart to itself
  return false;
}

std::uint32_t grow_disks(TriMesh const& mesh, FaceAdjacency const& adjacency, std::span<std::uint32_t const> seeds,
                         std::span<double const> priority, std::vector<std::uint32_t>& face_charts) {
  struct Candidate {
    double priority;
    std::uint32_t face, chart;
    bool operator<(Candidate const& other) const {
      return std::tuple(priority, other.face, other.chart) < std::tuple(other.priority, face, chart);
    }
  };
  std::uint32_t const faces = std::uint32_t(mesh.triangles.size());
  face_charts.assign(faces, kNone);
  std::uint32_t charts = 0;
  std::priority_queue<Candidate> queue;
  auto const assign = [&](std::uint32_t face, std::uint32_t chart) {
    face_charts[face] = chart;
    for (std::uint32_t neighbour : adjacency.across[face])
      if (neighbour != kNone && face_charts[neighbour] == kNone) queue.push({priority[neighbour], neighbour, chart});
  };
  auto const flood = [&] {
    while (!queue.empty()) {
      auto const [unused, face, chart] = queue.top();
      queue.pop();
      if (face_charts[face] == kNone && keeps_disk(mesh, adjacency, face_charts, face, chart)) assign(face, chart);
    }
  };
  for (std::uint32_t seed : seeds) assign(seed, charts++);
  flood();
  std::vector<std::uint32_t> order(faces);
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, std::greater(), [&](std::uint32_t f) { return priority[f]; });
  for (std::uint32_t face : order)
    if (face_charts[face] == kNone) {
      assign(face, charts++);
      flood();
    }
  return charts;
}

std::vector<std::vector<std::uint32_t>> cut_disk(TriMesh const& disk) {
  FaceAdjacency const adjacency = face_adjacency(disk);
  auto const farthest = [](std::vector<double> const& steps) {
    return std::uint32_t(std::ranges::max_element(steps) - steps.begin());
  };
  std::uint32_t const one_end = farthest(steps_from(adjacency, 0));
  std::vector<double> priority = steps_from(adjacency, one_end);
  std::uint32_t const other_end = farthest(priority);
  std::vector<double> const from_other = steps_from(adjacency, other_end);
  for (std::size_t f = 0; f < priority.size(); ++f) priority[f] = -std::min(priority[f], from_other[f]);
  std::vector<std::uint32_t> face_charts;
  std::uint32_t const charts = grow_disks(disk, adjacency, std::array{one_end, other_end}, priority, face_charts);
  return faces_of_charts(face_charts, charts);
}

std::vector<std::vector<std::uint32_t>> faces_of_charts(std::span<std::uint32_t const> face_charts,
                                                        std::uint32_t charts) {
  std::vector<std::vector<std::uint32_t>> faces(charts);
  for (std::uint32_t f = 0; f < face_charts.size(); ++f) faces[face_charts[f]].push_back(f);
  return faces;
}

TriMesh submesh(TriMesh const& mesh, std::span<std::uint32_t const> faces) {
  std::vector<std::uint32_t> vertices;
  for (std::uint32_t f : faces) vertices.insert(vertices.end(), mesh.triangles[f].begin(), mesh.triangles[f].end());
  std::ranges::sort(vertices);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  TriMesh part;
  for (std::uint32_t v : vertices) part.positions.push_back(mesh.positions[v]);
  for (std::uint32_t f : faces) {
    Triangle& t = part.triangles.emplace_back(mesh.triangles[f]);
    for (std::uint32_t& v : t) v = std::uint32_t(std::ranges::lower_bound(vertices, v) - vertices.begin());
  }
  return part;
}

}  // namespace vitrine
