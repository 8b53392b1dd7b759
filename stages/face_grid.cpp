// SPDX-License-Identifier: Apache-2.0
#include "stages/face_grid.h"

#include <algorithm>
#include <cmath>

namespace vitrine {
namespace {

constexpr double kMostCells = 1 << 19;
constexpr float kCell = 2;       ///< in reaches: most queries end in one cell, most faces lie in a few
constexpr float kSlack = 1e-3f;  ///< of a cell, around faces and queries: more than all rounding

}  // namespace

float usual_reach(TriMesh const& mesh) {
  double area = 0;
  for (auto const& [a, b, c] : mesh.triangles) {
    V3d const p(mesh.positions[a]);
    area += (V3d(mesh.positions[b]) - p).cross(V3d(mesh.positions[c]) - p).length() / 2;
  }
  return float(std::sqrt(area / double(mesh.triangles.size())) / 2);
}

FaceGrid::FaceGrid(TriMesh const& mesh, float reach) : reach_(reach) {
  Box3f box = bounds(mesh);
  box.min -= V3f(reach_), box.max += V3f(reach_);
  V3d const size(box.size());
  origin_ = box.min;
  cell_ = float(std::max(double(kCell * reach_), std::cbrt(size.x * size.y * size.z / kMostCells)));
  if (!(cell_ > 0)) return;
  for (int k = 0; k < 3; ++k) cells_[k] = std::max(1, int(std::ceil(size[k] / cell_)));

  faces_.reserve(mesh.triangles.size());
  for (auto const& [a, b, c] : mesh.triangles) {
    V3f const corner = mesh.positions[a];
    faces_.push_back(face(corner, mesh.positions[b] - corner, mesh.positions[c] - corner));
  }
  first_.assign(std::size_t(cells_.x) * cells_.y * cells_.z + 1, 0);
  for (Face const& face : faces_) for_cells(face, [&](std::size_t cell) { ++first_[cell]; });
  std::uint32_t sum = 0;
  for (std::uint32_t& first : first_)
    first = sum += first;  // where its list ends; filling it from behind moves that to its beginning
  listed_.resize(sum);
  for (std::size_t f = faces_.size(); f-- > 0;)
    for_cells(faces_[f], [&](std::size_t cell) { listed_[--first_[cell]] = std::uint32_t(f); });
}

FaceGrid::Face FaceGrid::face(V3f const& corner, V3f const& b, V3f const& c) {
  V3d const along_b(b), along_c(c), area = along_b.cross(along_c);
  double const area2 = area.length2();
  if (!(area2 > 0)) return {corner, b, c, V3f(0), V3f(0), V3f(0), {0, 0, 0}};
  V3d const u = along_c.cross(area) / area2, v = area.cross(along_b) / area2;
  return {corner,
          b,
          c,
          V3f(area.normalized()),
          V3f(u),
          V3f(v),
          {float(u.length2()), float(v.length2()), float((u + v).length2())}};
}

FaceGrid::Cells FaceGrid::cells_between(V3f const& low, V3f const& high) const {
  Cells cells;
  for (int k = 0; k < 3; ++k) {
    cells.from[k] = std::clamp(int((low[k] - origin_[k]) / cell_ - kSlack), 0, cells_[k] - 1);
    cells.to[k] = std::clamp(int((high[k] - origin_[k]) / cell_ + kSlack), 0, cells_[k] - 1);
  }
  return cells;
}

/// Calls visit(cell) for cells that the face touches; for a few more as well.
template <class Visit>
void FaceGrid::for_cells(Face const& face, Visit const& visit) const {
  Box3f box(face.corner);
  box.extendBy(face.corner + face.b);
  box.extendBy(face.corner + face.c);
  auto const [from, to] = cells_between(box.min, box.max);
  V3f const n = face.normal;
  float const thickness = cell_ * (0.5f + kSlack) * (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
  for (int z = from.z; z <= to.z; ++z)
    for (int y = from.y; y <= to.y; ++y)
      for (int x = from.x; x <= to.x; ++x) {
        V3f const centre = origin_ + V3f(float(x) + 0.5f, float(y) + 0.5f, float(z) + 0.5f) * cell_;
        if (std::abs((centre - face.corner).dot(n)) <= thickness) visit(index({x, y, z}));
      }
}

void FaceGrid::improve(std::uint32_t index, V3f const& point, V3f const& side, std::optional<Match>& best,
                       float& least) const {
  Face const& face = faces_[index];
  V3f const p = point - face.corner;
  float const height = p.dot(face.normal), left = least - height * height;
  if (!(left > 0) || (side != V3f(0) && !(side.dot(face.normal) > 0))) return;
  Barycentric at{face.slope_u.dot(p), face.slope_v.dot(p)};
  std::array<float, 3> const weights{at.u, at.v, 1 - at.u - at.v};
  bool inside = face.normal != V3f(0);
  for (int k = 0; k < 3; ++k)
    if (weights[k] < 0) {
      if (weights[k] * weights[k] >= left * face.slopes2[k]) return;  // as far as that beyond an edge's line
      inside = false;
    }
  float distance2 = height * height;
  if (!inside) {
    at = closest_on_triangle(p, face.b, face.c);
    distance2 = (p - face.b * at.u - face.c * at.v).length2();
    if (!(distance2 < least)) return;
  }
  least = distance2;
  best = Match{index, at};
}

std::optional<FaceGrid::Match> FaceGrid::closest(V3f const& point, V3f const& side, std::uint32_t hint) const {
  V3f const place = (point - origin_) / cell_;
  for (int k = 0; k < 3; ++k)
    if (!(place[k] >= 0 && place[k] < float(cells_[k]))) return std::nullopt;
  std::optional<Match> best;
  float least = reach_ * reach_;
  auto const search = [&](std::size_t cell) {
    for (std::uint32_t i = first_[cell]; i < first_[cell + 1]; ++i)
      if (listed_[i] != hint) improve(listed_[i], point, side, best, least);
  };
  if (hint < faces_.size()) improve(hint, point, side, best, least);
  std::size_t const home = index(Imath::V3i(int(place.x), int(place.y), int(place.z)));
  search(home);
  V3f const radius(std::sqrt(least));
  auto const [from, to] = cells_between(point - radius, point + radius);
  for (int z = from.z; z <= to.z; ++z)
    for (int y = from.y; y <= to.y; ++y)
      for (int x = from.x; x <= to.x; ++x)
        if (std::size_t const cell = index({x, y, z}); cell != home) search(cell);
  return best;
}

}  // namespace vitrine
