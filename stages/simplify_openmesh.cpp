// SPDX-License-Identifier: Apache-2.0
// OpenMesh's templates are not clean under our warnings.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalFlippingT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#pragma GCC diagnostic pop

#include "stages/error.h"
#include "stages/simplify_openmesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>

namespace vitrine {
namespace {

using Index = std::uint32_t;
constexpr Index kNone = ~Index{0};

struct Traits : OpenMesh::DefaultTraitsDouble {
  VertexTraits {
    Index original = 0;
    double weight = 0;  // of the planes in its quadric
  };
};
using HalfEdgeMesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;
using Decimater = OpenMesh::Decimater::DecimaterT<HalfEdgeMesh>;
using CollapseInfo = OpenMesh::Decimater::CollapseInfoT<HalfEdgeMesh>;

/// OpenMesh's quadrics with our measure of distance: the root of the mean square, weighted by area.
class Quadrics : public OpenMesh::Decimater::ModQuadricT<HalfEdgeMesh> {
 public:
  using Base = OpenMesh::Decimater::ModQuadricT<HalfEdgeMesh>;
  explicit Quadrics(HalfEdgeMesh& mesh) : Base(mesh) {}

  float collapse_priority(CollapseInfo const& info) override {
    float const error =
        std::max(0.0f, Base::collapse_priority(info));  // below zero by rounding where the surface is flat
    if (distance(info, error) <= max_distance_) return error;
    limited_ = true;
    return Base::ILLEGAL_COLLAPSE;
  }
  void preprocess_collapse(CollapseInfo const& info) override {
    largest_distance_ = std::max(largest_distance_, distance(info, std::max(0.0f, Base::collapse_priority(info))));
  }
  void postprocess_collapse(CollapseInfo const& info) override {
    Base::postprocess_collapse(info);
    mesh().data(info.v1).weight += mesh().data(info.v0).weight;
  }

  void set_max_distance(double distance) { max_distance_ = distance; }
  double largest_distance() const { return largest_distance_; }
  bool limited() const { return limited_; }

 private:
  double distance(CollapseInfo const& info, double error) {
    double const weight = mesh().data(info.v0).weight + mesh().data(info.v1).weight;
    return weight > 0 ? std::sqrt(error / weight) : 0;
  }

  double max_distance_ = 0, largest_distance_ = 0;
  bool limited_ = false;
};

Index root(std::vector<Index>& parents, Index i) {
  while (parents[i] != i) i = parents[i] = parents[parents[i]];
  return i;
}

/// The corners (3 f + k) of a mesh grouped into the vertices of a manifold one.
struct Fans {
  std::vector<Index> of_corners;  ///< 3 f, below `count`
  Index count = 0;
};

/// Corners share a vertex where their faces share an edge of two faces, wound alike. What meets in one vertex or in
/// other edges comes apart.
Fans cut_to_fans(TriMesh const& mesh) {
  struct Side {
    Index low, high, corner;  ///< the edge from `corner` to the next one of its face
    bool rising;
  };
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (Index f = 0; f < mesh.triangles.size(); ++f)
    for (Index k = 0; k < 3; ++k) {
      Index const from = mesh.triangles[f][k], to = mesh.triangles[f][(k + 1) % 3];
      sides.push_back({std::min(from, to), std::max(from, to), 3 * f + k, from < to});
    }
  std::sort(sides.begin(), sides.end(), [](Side const& x, Side const& y) {
    return std::tuple(x.low, x.high, x.corner) < std::tuple(y.low, y.high, y.corner);
  });

  std::vector<Index> parents(sides.size());
  std::iota(parents.begin(), parents.end(), Index{0});
  auto next = [](Index corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; };
  auto join = [&](Index x, Index y) {
    Index const p = root(parents, x), q = root(parents, y);
    parents[std::max(p, q)] = std::min(p, q);
  };
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && sides[end].low == sides[begin].low && sides[end].high == sides[begin].high) ++end;
    if (end - begin != 2 || sides[begin].rising == sides[begin + 1].rising) continue;
    join(sides[begin].corner, next(sides[begin + 1].corner));
    join(next(sides[begin].corner), sides[begin + 1].corner);
  }

  Fans fans{std::vector<Index>(parents.size()), 0};
  for (Index c = 0; c < parents.size(); ++c)  // a root comes before all others of its fan
    fans.of_corners[c] = parents[c] == c ? fans.count++ : fans.of_corners[root(parents, c)];
  return fans;
}

/// A manifold copy in the unit box.
HalfEdgeMesh manifold_copy(TriMesh const& mesh) {
  Box3f const box = bounds(mesh);
  V3d const centre = (V3d(box.min) + V3d(box.max)) / 2, size = V3d(box.max) - V3d(box.min);
  double const longest = std::max({size.x, size.y, size.z}), scale = longest > 0 ? 1 / longest : 1;

  Fans const fans = cut_to_fans(mesh);
  std::vector<Index> originals(fans.count);
  for (Index c = 0; c < fans.of_corners.size(); ++c) originals[fans.of_corners[c]] = mesh.triangles[c / 3][c % 3];
  HalfEdgeMesh copy;
  copy.reserve(fans.count, 3 * mesh.triangles.size() / 2, mesh.triangles.size());
  for (Index original : originals) {
    V3d const p = (V3d(mesh.positions[original]) - centre) * scale;
    copy.data(copy.add_vertex({p.x, p.y, p.z})).original = original;
  }
  for (Index f = 0; f < mesh.triangles.size(); ++f) {
    auto corner = [&](Index k) { return copy.vertex_handle(fans.of_corners[3 * f + k]); };
    auto const face = copy.add_face(corner(0), corner(1), corner(2));
    if (!face.is_valid())
      throw Error(ErrorKind::broken, "OpenMesh refuses face " + std::to_string(f) + " of a manifold copy",
                  "use --decimator optimal, and report this model");
    double const area = copy.calc_face_area(face);
    for (Index k = 0; k < 3; ++k) copy.data(corner(k)).weight += area;
  }
  return copy;
}

/// The light mesh over the vertices of the original: what was cut is one again. Faces that collapse by that go.
TriMesh welded(HalfEdgeMesh const& copy, TriMesh const& mesh) {
  std::vector<Index> renamed(mesh.positions.size(), kNone);
  TriMesh result;
  for (auto const face : copy.faces()) {
    Triangle t{};
    std::size_t k = 0;
    for (auto const v : copy.fv_range(face)) t[k++] = copy.data(v).original;
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    for (Index& v : t) {
      if (renamed[v] == kNone) {
        renamed[v] = static_cast<Index>(result.positions.size());
        result.positions.push_back(mesh.positions[v]);
      }
      v = renamed[v];
    }
    result.triangles.push_back(t);
  }
  return result;
}

}  // namespace

SimplifiedMesh simplify_openmesh(TriMesh const& mesh, SimplifyOptions const& options) {
  HalfEdgeMesh copy = manifold_copy(mesh);
  copy.request_face_normals();
  copy.update_face_normals();

  Box3f const box = bounds(mesh);
  V3d const size = V3d(box.max) - V3d(box.min);
  double const diagonal = size.length() / std::max({size.x, size.y, size.z});

  Decimater decimater(copy);
  OpenMesh::Decimater::ModHandleT<Quadrics> quadrics;
  OpenMesh::Decimater::ModNormalFlippingT<HalfEdgeMesh>::Handle flipping;
  decimater.add(quadrics);
  decimater.add(flipping);
  decimater.module(quadrics).set_max_distance(options.max_error * diagonal);
  decimater.initialize();
  decimater.decimate_to_faces(0, std::size_t(options.triangles));
  Quadrics const& done = decimater.module(quadrics);
  copy.garbage_collection();

  TriMesh light = welded(copy, mesh);
  StopReason const stop = light.triangles.size() <= std::size_t(options.triangles) ? StopReason::target_reached
                          : done.limited()                                         ? StopReason::error_limit
                                                                                   : StopReason::nothing_left;
  return {std::move(light), static_cast<float>(done.largest_distance() / diagonal), stop};
}

}  // namespace vitrine
