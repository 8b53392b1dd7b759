// SPDX-License-Identifier: Apache-2.0
#include "stages/clean.h"

#include "stages/error.h"
#include "stages/first_equal.h"
#include "stages/parallel.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

namespace vitrine {
namespace {

constexpr std::size_t kGrain = std::size_t{1} << 15;
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

Triangle placed(Triangle const& t, std::vector<std::uint32_t> const& places) {
  return {places[t[0]], places[t[1]], places[t[2]]};
}

bool collapsed(Triangle const& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

/// Whether a point is near enough that squares of lengths stay finite in float.
bool has_place(V3f const& p) {
  float const farthest = 1e18f;
  return std::abs(p.x) < farthest && std::abs(p.y) < farthest && std::abs(p.z) < farthest;
}

/// Along the normal, twice as long as the face's area.
V3d area_vector(TriMesh const& mesh, Triangle const& t) {
  V3d const a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
  return (b - a).cross(c - a);
}

/// Whether the corners lie on one line, as far as float coordinates can tell.
bool collinear(TriMesh const& mesh, Triangle const& t) {
  V3d const a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
  double const longest2 = std::max({(b - a).length2(), (c - b).length2(), (a - c).length2()});
  return !((b - a).cross(c - a).length() > std::numeric_limits<float>::epsilon() * longest2);
}

/// Removes items whose flag is not set; the others keep their order.
template <class T>
void compact(std::vector<T>& items, std::vector<std::uint8_t> const& keep) {
  if (items.empty()) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < items.size(); ++i)
    if (keep[i]) items[kept++] = items[i];
  items.resize(kept);
}

/// Keeps the faces for which keep(f); returns how many went.
template <class Keep>
std::uint64_t drop_faces(SourceModel& model, Keep const& keep) {
  std::size_t const before = model.mesh.triangles.size();
  std::vector<std::uint8_t> flags(before);
  parallel_for(before, kGrain, [&](std::size_t f) { flags[f] = keep(f); });
  compact(model.mesh.triangles, flags);
  compact(model.face_materials, flags);
  return before - model.mesh.triangles.size();
}

std::uint64_t drop_faces_without_place(SourceModel& model) {
  std::vector<V3f> const& positions = model.mesh.positions;
  std::uint64_t lost = 0;
  for (V3f const& p : positions) lost += !has_place(p);
  if (lost == 0) return 0;
  drop_faces(model, [&](std::size_t f) {
    Triangle const& t = model.mesh.triangles[f];
    return has_place(positions[t[0]]) && has_place(positions[t[1]]) && has_place(positions[t[2]]);
  });
  return lost;
}

std::uint64_t drop_faces_without_area(SourceModel& model, std::vector<std::uint32_t> const& places) {
  return drop_faces(model, [&](std::size_t f) {
    Triangle const& t = model.mesh.triangles[f];
    return !collapsed(placed(t, places)) && !collinear(model.mesh, t);
  });
}

/// With the lowest corner first.
Triangle turned(Triangle t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

/// The last is kept, which clients draw over the others; but the other side of the first only in another material.
std::uint64_t drop_duplicate_faces(SourceModel& model, std::vector<std::uint32_t> const& places) {
  auto const material = [&](std::size_t f) { return model.face_materials.empty() ? 0 : model.face_materials[f]; };
  auto const at = [&](std::size_t f) { return turned(placed(model.mesh.triangles[f], places)); };
  std::vector<std::uint32_t> const first = first_equal(model.mesh.triangles.size(), [&](std::size_t f) {
    Triangle t = placed(model.mesh.triangles[f], places);
    std::sort(t.begin(), t.end());
    return t;
  });
  std::vector<std::uint32_t> kept = first;  // by the first of each
  for (std::uint32_t f = 0; f < first.size(); ++f)
    if (first[f] != f && (at(f) == at(first[f]) || material(f) != material(first[f]))) kept[first[f]] = f;
  return drop_faces(model, [&](std::size_t f) { return kept[first[f]] == f; });
}

/// Turns all faces round if more area lies against the vertices' normals than with them.
std::uint64_t turn_round(SourceModel& model) {
  std::vector<V3f> const& normals = model.normals;
  std::vector<Triangle>& triangles = model.mesh.triangles;
  double const with = parallel_reduce(
      triangles.size(), kGrain, 0.0,
      [&](std::size_t begin, std::size_t end) {
        double sum = 0;
        for (std::size_t f = begin; f < end; ++f) {
          Triangle const& t = triangles[f];
          V3d const area = area_vector(model.mesh, t);
          double const side = area.dot(V3d(normals[t[0]]) + V3d(normals[t[1]]) + V3d(normals[t[2]]));
          if (side != 0) sum += std::copysign(area.length(), side);
        }
        return sum;
      },
      [](double total, double part) { return total + part; });
  if (with >= 0) return 0;
  for (Triangle& t : triangles) std::swap(t[1], t[2]);
  return triangles.size();
}

/// Makes normals unit; those without a direction become zero. Returns how many those are.
std::uint64_t make_unit(std::vector<V3f>& normals) {
  std::uint64_t without = 0;
  for (V3f& normal : normals) {
    double const length = V3d(normal).length();
    bool const usable = std::isfinite(length) && length > 0;
    normal = usable ? V3f(V3d(normal) / length) : V3f(0);
    without += !usable;
  }
  return without;
}

/// Replaces zero normals by the surface's.
void fill_normals(SourceModel& model, std::vector<std::uint32_t> const& places) {
  std::vector<V3f> const surface = smooth_normals(model.mesh, places);
  for (std::size_t v = 0; v < surface.size(); ++v)
    if (model.normals[v] == V3f(0)) model.normals[v] = surface[v];
}

/// Returns whether there were any.
bool drop_unused_vertices(SourceModel& model) {
  std::vector<std::uint8_t> used(model.mesh.positions.size(), 0);
  for (Triangle const& t : model.mesh.triangles)
    for (std::uint32_t v : t) used[v] = 1;
  std::vector<std::uint32_t> renamed(used.size());
  std::uint32_t count = 0;
  for (std::size_t v = 0; v < used.size(); ++v) renamed[v] = used[v] ? count++ : kNone;
  if (count == used.size()) return false;
  for (Triangle& t : model.mesh.triangles) t = placed(t, renamed);
  compact(model.mesh.positions, used);
  compact(model.normals, used);
  compact(model.tangents, used);
  compact(model.uvs, used);
  compact(model.colours, used);
  return true;
}

}  // namespace

std::vector<V3f> smooth_normals(TriMesh const& mesh, std::vector<std::uint32_t> const& places) {
  std::vector<V3f> normals(mesh.positions.size(), V3f(0));
  // Areas as shares of the largest face's: no model is too small or too large for the sums in float.
  double const largest = parallel_reduce(
      mesh.triangles.size(), kGrain, 0.0,
      [&](std::size_t begin, std::size_t end) {
        double most = 0;
        for (std::size_t f = begin; f < end; ++f) most = std::max(most, area_vector(mesh, mesh.triangles[f]).length());
        return most;
      },
      [](double total, double part) { return std::max(total, part); });
  double const scale = largest > 0 ? 1 / largest : 0;
  for (Triangle const& t : mesh.triangles) {
    V3f const normal(area_vector(mesh, t) * scale);
    for (std::uint32_t v : t) normals[places[v]] += normal;
  }
  parallel_for(normals.size(), kGrain, [&](std::size_t v) {
    if (places[v] == v) normals[v] = normals[v].length() > 0 ? normals[v].normalized() : V3f(0, 1, 0);
  });
  parallel_for(normals.size(), kGrain, [&](std::size_t v) {
    if (places[v] != v) normals[v] = normals[places[v]];
  });
  return normals;
}

CleanModel clean(SourceModel source) {
  CleanModel result{std::move(source), {}, false};
  SourceModel& model = result.model;
  Repairs& repairs = result.repairs;
  std::size_t const faces = model.mesh.triangles.size();

  repairs.nonfinite_vertices = drop_faces_without_place(model);
  std::vector<std::uint32_t> places = shared_places(model.mesh);
  repairs.degenerate_faces = drop_faces_without_area(model, places);
  repairs.duplicate_faces = drop_duplicate_faces(model, places);
  if (model.mesh.triangles.empty())
    throw Error(ErrorKind::invalid_input, "none of " + std::to_string(faces) + " faces has an area",
                "check that the file holds a surface, not points or lines alone");

  if (drop_unused_vertices(model)) places = shared_places(model.mesh);

  result.computed_normals = model.normals.empty();
  if (result.computed_normals) {
    model.normals = smooth_normals(model.mesh, places);
  } else {
    repairs.repaired_normals = make_unit(model.normals);
    repairs.flipped_faces = turn_round(model);
    if (repairs.repaired_normals > 0) fill_normals(model, places);
  }
  return result;
}

TriMesh weld(SourceModel const& model) {
  std::vector<std::uint32_t> const places = shared_places(model.mesh);
  TriMesh welded;
  std::vector<std::uint32_t> renamed(places.size());
  for (std::size_t v = 0; v < places.size(); ++v) {
    if (places[v] == v) {
      renamed[v] = static_cast<std::uint32_t>(welded.positions.size());
      welded.positions.push_back(model.mesh.positions[v]);
    } else {
      renamed[v] = renamed[places[v]];
    }
  }
  welded.triangles.reserve(model.mesh.triangles.size());
  for (Triangle const& t : model.mesh.triangles)
    if (Triangle const joined = placed(t, renamed); !collapsed(joined)) welded.triangles.push_back(joined);
  return welded;
}

std::vector<std::uint32_t> shared_places(TriMesh const& mesh) {
  auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x + 0.0f); };  // -0 + 0 = +0
  return first_equal(mesh.positions.size(), [&](std::size_t v) {
    V3f const& p = mesh.positions[v];
    return Key{bits(p.x), bits(p.y), bits(p.z)};
  });
}

std::vector<std::uint32_t> merged_places(TriMesh const& mesh) {
  if (mesh.positions.size() > mesh.triangles.size()) return shared_places(mesh);
  std::vector<std::uint32_t> self(mesh.positions.size());
  std::iota(self.begin(), self.end(), 0u);
  return self;
}

std::vector<V3f> smooth_normals(TriMesh const& mesh) { return smooth_normals(mesh, shared_places(mesh)); }

}  // namespace vitrine
