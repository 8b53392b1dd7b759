// SPDX-License-Identifier: Apache-2.0
#include "stages/flatten.h"

#include "stages/planar_face.h"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace vitrine {
namespace {

constexpr double kTrimmed = 0.02;  ///< of the area, at either end, does not count for the spread of areas

/// The boundary as a loop of vertices, front faces on its left.
std::vector<std::uint32_t> boundary_loop(TriMesh const& disk) {
  struct HalfEdge {
    std::uint64_t edge;  ///< its lower vertex, then its higher one
    std::uint32_t from, to;
  };
  std::vector<HalfEdge> half_edges;
  half_edges.reserve(3 * disk.triangles.size());
  for (Triangle const& t : disk.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      auto const [low, high] = std::minmax(t[i], t[(i + 1) % 3]);
      half_edges.push_back({std::uint64_t{low} << 32 | high, t[i], t[(i + 1) % 3]});
    }
  std::ranges::sort(half_edges, {}, &HalfEdge::edge);
  std::vector<std::uint32_t> next(disk.positions.size()), loop;
  std::size_t borders = 0;
  for (std::size_t i = 0; i < half_edges.size(); ++i) {
    if (i + 1 < half_edges.size() && half_edges[i].edge == half_edges[i + 1].edge) {
      ++i;  // between two faces
      continue;
    }
    next[half_edges[i].from] = half_edges[i].to;
    if (borders++ == 0) loop.push_back(half_edges[i].from);
  }
  while (loop.size() < borders) loop.push_back(next[loop.back()]);
  return loop;
}

/// The two vertices of the loop that are farthest apart in space; the first such pair.
std::pair<std::uint32_t, std::uint32_t> farthest_pair(TriMesh const& disk, std::vector<std::uint32_t> const& loop) {
  std::vector<V3d> points;
  for (std::uint32_t v : loop) points.emplace_back(disk.positions[v]);
  std::pair<std::uint32_t, std::uint32_t> best{loop[0], loop[1]};
  double distance = -1;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = i + 1; j < points.size(); ++j)
      if (double const d = (points[i] - points[j]).length2(); d > distance) distance = d, best = {loop[i], loop[j]};
  return best;
}

/// Minimises the sum over faces of |sum_j w_j u_j|^2 / (2 area), w_j the edge opposite to corner j, u the complex uv:
/// zero where the map of the face is a similarity. Empty if the system cannot be factorised.
std::vector<Complex> conformal_map(TriMesh const& disk, std::vector<PlanarFace> const& faces,
                                   std::pair<std::uint32_t, std::uint32_t> pins) {
  std::size_t const n = disk.positions.size();
  std::vector<int> unknown(n);
  int unknowns = 0;
  for (std::uint32_t v = 0; v < n; ++v) unknown[v] = v == pins.first || v == pins.second ? -1 : unknowns++;
  std::vector<Complex> uv(n);
  double const apart = (V3d(disk.positions[pins.first]) - V3d(disk.positions[pins.second])).length();
  uv[pins.second] = apart > 0 ? apart : 1;

  std::vector<Eigen::Triplet<Complex>> entries;
  Eigen::VectorXcd right = Eigen::VectorXcd::Zero(unknowns);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    auto const& corners = faces[f].corners;
    Triangle const& t = disk.triangles[f];
    for (std::size_t i = 0; i < 3; ++i) {
      if (unknown[t[i]] < 0) continue;
      Complex const row = std::conj(corners[(i + 2) % 3] - corners[(i + 1) % 3]) / (2 * faces[f].area());
      for (std::size_t j = 0; j < 3; ++j) {
        Complex const entry = row * (corners[(j + 2) % 3] - corners[(j + 1) % 3]);
        if (unknown[t[j]] < 0)
          right[unknown[t[i]]] -= entry * uv[t[j]];
        else if (unknown[t[j]] <= unknown[t[i]])
          entries.emplace_back(unknown[t[i]], unknown[t[j]], entry);
      }
    }
  }
  Eigen::SparseMatrix<Complex> normal_matrix(unknowns, unknowns);
  normal_matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<Complex>, Eigen::Lower> const solver(normal_matrix);
  if (solver.info() != Eigen::Success) return {};
  Eigen::VectorXcd const solution = solver.solve(right);
  if (!solution.allFinite()) return {};
  for (std::size_t v = 0; v < n; ++v)
    if (unknown[v] >= 0) uv[v] = solution[unknown[v]];
  return uv;
}

/// Rounds to float after scaling to the area in space; v is turned down, from the plane's upward axis to the image's.
std::vector<V2f> to_image_axes(TriMesh const& disk, std::vector<PlanarFace> const& faces,
                               std::vector<Complex> const& uv) {
  double flat_area = 0, area = 0;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    Triangle const& t = disk.triangles[f];
    flat_area += cross(uv[t[1]] - uv[t[0]], uv[t[2]] - uv[t[0]]) / 2;
    area += faces[f].area();
  }
  double const scale = flat_area > 0 ? std::sqrt(area / flat_area) : 1;
  std::vector<V2f> result;
  result.reserve(uv.size());
  for (Complex z : uv) result.emplace_back(float(scale * z.real()), float(-scale * z.imag()));
  return result;
}

/// Whether segments ab and cd cross. A point exactly on a line counts as on its left, so that a crossing through a
/// shared point is never missed.
bool cross_each_other(Complex a, Complex b, Complex c, Complex d) {
  auto const left = [](Complex p, Complex q, Complex r) { return cross(q - p, r - p) >= 0; };
  return left(a, b, c) != left(a, b, d) && left(c, d, a) != left(c, d, b);
}

/// Sweeps the edges from left to right. A map without folds whose boundary is simple covers each point once.
bool boundary_crosses_itself(std::vector<std::uint32_t> const& loop, std::vector<V2f> const& uvs) {
  std::size_t const n = loop.size();
  std::vector<Complex> points;
  for (std::size_t i = 0; i <= n; ++i) points.push_back(plane(uvs[loop[i % n]]));
  auto const at = [&](std::size_t i) { return points[i]; };
  std::vector<std::pair<double, std::size_t>> edges;  // left end, index in the loop
  for (std::size_t i = 0; i < n; ++i) edges.emplace_back(std::min(at(i).real(), at(i + 1).real()), i);
  std::ranges::sort(edges);
  for (std::size_t e = 0; e < n; ++e) {
    std::size_t const i = edges[e].second;
    double const right_end = std::max(at(i).real(), at(i + 1).real());
    for (std::size_t g = e + 1; g < n && edges[g].first <= right_end; ++g) {
      std::size_t const j = edges[g].second;
      if ((i + 1) % n != j && (j + 1) % n != i && cross_each_other(at(i), at(i + 1), at(j), at(j + 1))) return true;
    }
  }
  return false;
}

/// Sum of squares of the singular values of the map from the plane of uv to the face in space.
double squared_stretch(std::array<Complex, 3> const& uv, PlanarFace const& face, double twice_flat_area) {
  Complex dp_du = 0, dp_dv = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    Complex const opposite = uv[(i + 2) % 3] - uv[(i + 1) % 3];
    dp_du -= face.corners[i] * opposite.imag();
    dp_dv += face.corners[i] * opposite.real();
  }
  return (std::norm(dp_du) + std::norm(dp_dv)) / (twice_flat_area * twice_flat_area);
}

/// Ratio of the scales of area that bound all but kTrimmed of the area at either end.
double spread(std::vector<std::pair<double, double>> scale_and_area) {
  std::ranges::sort(scale_and_area);
  double total = 0, seen = 0, low = 0, high = 0;
  for (auto const& [scale, area] : scale_and_area) total += area;
  for (auto const& [scale, area] : scale_and_area) {
    if (seen <= kTrimmed * total) low = scale;
    if (seen < (1 - kTrimmed) * total) high = scale;
    seen += area;
  }
  return high / low;
}

/// Judges the map as rounded, so that what is promised holds for what is handed on.
void measure(TriMesh const& disk, std::vector<PlanarFace> const& faces, FlatDisk& flat) {
  Imath::Box2f box;
  for (V2f const& uv : flat.uvs) box.extendBy(uv);
  double const extent = Imath::V2d(box.size()).length();
  flat.length = std::max(box.size().x, box.size().y);
  double sum = 0, area = 0;
  std::vector<std::pair<double, double>> scales;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    auto const [a, b, c] = disk.triangles[f];
    std::array<Complex, 3> const uv{plane(flat.uvs[a]), plane(flat.uvs[b]), plane(flat.uvs[c])};
    double const longest = std::max({std::abs(uv[1] - uv[0]), std::abs(uv[2] - uv[1]), std::abs(uv[0] - uv[2])});
    double const noise = kThinnest * extent * longest, twice = cross(uv[1] - uv[0], uv[2] - uv[0]);
    if (twice < -noise) flat.folded = true;
    double const face_area = faces[f].area(), flat_area = std::max({twice, noise, std::numeric_limits<double>::min()});
    sum += face_area * squared_stretch(uv, faces[f], flat_area) / 2;
    area += face_area;
    scales.emplace_back(flat_area / (2 * face_area), face_area);
  }
  flat.stretch = std::sqrt(sum / area);
  flat.area_spread = spread(std::move(scales));
}

double diagonal(TriMesh const& disk) {
  Box3f const box = bounds(disk);
  return (V3d(box.max) - V3d(box.min)).length();
}

}  // namespace

bool lies_flat(FlatDisk const& flat, FlatLimits const& limits) {
  return !flat.folded && !flat.overlapping && flat.stretch <= limits.stretch && flat.area_spread <= limits.area_spread;
}

FlatDisk judged(TriMesh const& disk, std::vector<V2f> uvs) {
  FlatDisk flat;
  flat.uvs = std::move(uvs);
  measure(disk, lay_faces_flat(disk, diagonal(disk)), flat);
  flat.overlapping = boundary_crosses_itself(boundary_loop(disk), flat.uvs);
  return flat;
}

FlatDisk flatten(TriMesh const& disk) {
  FlatDisk flat;
  flat.uvs.assign(disk.positions.size(), V2f(0));
  double const size = diagonal(disk);
  if (size == 0) return flat;  // a dot
  std::vector<PlanarFace> const faces = lay_faces_flat(disk, size);
  std::vector<std::uint32_t> const loop = boundary_loop(disk);
  std::vector<Complex> const uv = conformal_map(disk, faces, farthest_pair(disk, loop));
  if (uv.empty()) {
    flat.folded = true;
    return flat;
  }
  return judged(disk, to_image_axes(disk, faces, uv));
}

}  // namespace vitrine
