// SPDX-License-Identifier: Apache-2.0
#include "stages/occlusion.h"

#include "stages/closest_point.h"
#include "stages/parallel.h"
#include "stages/surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace vitrine {
namespace {

/// Of the bounding box's diagonal: the side of a cell, and how far off the surface rays start.
constexpr float kCell = 1.0f / 256, kOffset = 1e-4f;

/// Of all cut faces together; where they would need more, the cells grow.
constexpr std::size_t kMostInnerPlaces = std::size_t{1} << 20;

constexpr std::uint32_t kNoFace = 0xffffffffu;

/// Mixes all bits into all others. Source: the finaliser of MurmurHash3, Appleby 2011.
std::uint32_t scramble(std::uint32_t x) {
  x = (x ^ (x >> 16)) * 0x85ebca6bu;
  x = (x ^ (x >> 13)) * 0xc2b2ae35u;
  return x ^ (x >> 16);
}

/// Bits in reverse order: the radical inverse in base 2, as a share of 2^32.
std::uint32_t reverse(std::uint32_t x) {
  x = (x << 16) | (x >> 16);
  x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
  x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
  x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
  return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
}

float unit(std::uint32_t x) { return float(x >> 8) / 16777216.f; }

/// Any two unit vectors that make a right-handed frame with n. Source: Duff et al. 2017, "Building an Orthonormal
/// Basis, Revisited".
struct Basis {
  V3f x, y;
  explicit Basis(V3f const& n) {
    float const sign = std::copysign(1.f, n.z), a = -1 / (sign + n.z), b = n.x * n.y * a;
    x = {1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
    y = {b, sign + n.y * n.y * a, -n.y};
  }
};

/// The i-th of `count` directions about the unit `normal`, as dense as the cosine; `pattern` turns them.
V3f sky_direction(V3f const& normal, int i, int count, std::uint32_t pattern) {
  Basis const basis(normal);
  float const a = (float(i) + unit(scramble(2 * pattern))) / float(count);
  float const b = unit(reverse(std::uint32_t(i)) + scramble(2 * pattern + 1));
  float const radius = std::sqrt(a), angle = 2 * std::numbers::pi_v<float> * b;
  return basis.x * (radius * std::cos(angle)) + basis.y * (radius * std::sin(angle)) +
         normal * std::sqrt(std::max(0.f, 1 - a));
}

std::array<V3f, 3> corners(TriMesh const& mesh, std::uint32_t face) {
  Triangle const& t = mesh.triangles[face];
  return {mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
}

/// Places in a face cut into steps^2 along its second and third corner.
std::size_t places_of(std::size_t steps) { return (steps + 1) * (steps + 2) / 2; }
std::size_t place_in_cut(std::size_t steps, std::size_t column, std::size_t row) {
  return row * (steps + 1) - row * (row - 1) / 2 + column;
}

/// 1: not cut. Long thin faces are cut more coarsely than cells: places grow with the square of the steps.
std::uint32_t steps_of(std::array<V3f, 3> const& p, float cell) {
  V3f const b = p[1] - p[0], c = p[2] - p[0];
  float const longest = std::sqrt(std::max({b.length2(), c.length2(), (c - b).length2()}));
  if (!(longest > 2 * cell)) return 1;
  float const by_area = 8 + 2 * std::sqrt(b.cross(c).length() / 2) / cell;
  return static_cast<std::uint32_t>(std::ceil(std::min(longest / cell, by_area)));
}

/// A place to start rays from, and the cell that it lies in.
struct Place {
  std::uint64_t cell;
  std::uint32_t face;
  float u, v;
};

/// Numbers the cells of the grid about a mesh; the two sides of a thin wall lie in different ones.
class Cells {
 public:
  Cells(Box3f const& box, float side) : low_(box.min), per_unit_(side > 0 ? 1 / side : 0) {}

  std::uint64_t operator()(V3f const& point, V3f const& normal) const {
    V3f const at = (point - low_) * per_unit_;
    V3f const size(std::abs(normal.x), std::abs(normal.y), std::abs(normal.z));
    int const axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    std::uint64_t key = 0;
    for (int k = 0; k < 3; ++k) key = key << 12 | static_cast<std::uint64_t>(std::clamp(at[k], 0.f, 4095.f));
    return key << 3 | static_cast<std::uint64_t>(2 * axis + (normal[axis] < 0));
  }

 private:
  V3f low_;
  float per_unit_;
};

/// Faces to cut so that no two places are much farther apart than a cell; enlarges it until they are few enough.
std::vector<OcclusionField::Cut> cut_faces(TriMesh const& mesh, float& cell) {
  for (;; cell *= 1.4f) {
    std::vector<OcclusionField::Cut> cuts;
    std::size_t first = mesh.positions.size();
    for (std::uint32_t face = 0; face < mesh.triangles.size(); ++face) {
      std::uint32_t const steps = steps_of(corners(mesh, face), cell);
      if (steps == 1) continue;
      cuts.push_back({face, static_cast<std::uint32_t>(first), steps});
      first += places_of(steps);
      if (first > mesh.positions.size() + kMostInnerPlaces) break;
    }
    if (first <= mesh.positions.size() + kMostInnerPlaces) return cuts;
  }
}

/// The vertices, each in its first face (in none when no face uses it), then the places inside cut faces.
std::vector<Place> all_places(TriMesh const& mesh, std::vector<OcclusionField::Cut> const& cuts) {
  std::size_t const inner = cuts.empty() ? 0 : cuts.back().first + places_of(cuts.back().steps) - mesh.positions.size();
  std::vector<Place> places(mesh.positions.size() + inner, Place{0, kNoFace, 0, 0});
  for (std::uint32_t face = 0; face < mesh.triangles.size(); ++face)
    for (std::size_t k = 0; k < 3; ++k)
      if (Place& place = places[mesh.triangles[face][k]]; place.face == kNoFace)
        place = {0, face, k == 1 ? 1.f : 0.f, k == 2 ? 1.f : 0.f};
  for (OcclusionField::Cut const& cut : cuts)
    for (std::uint32_t row = 0; row <= cut.steps; ++row)
      for (std::uint32_t column = 0; row + column <= cut.steps; ++column)
        places[cut.first + place_in_cut(cut.steps, column, row)] = {0, cut.face, float(column) / float(cut.steps),
                                                                    float(row) / float(cut.steps)};
  return places;
}

/// Where a place is, and which way it looks.
struct Lookout {
  V3f point, normal;
};

class Tracer {
 public:
  Tracer(TriMesh const& mesh, RayScene const& scene, Surface const& surface, int rays)
      : mesh_(mesh), scene_(scene), surface_(surface), rays_(static_cast<std::size_t>(rays)) {}

  Lookout lookout(Place const& place) const {
    auto const p = corners(mesh_, place.face);
    return {interpolate(p[0], p[1], p[2], Barycentric{place.u, place.v}),
            surface_.sample(Hit{place.face, place.u, place.v, 0}, 0).normal};
  }

  /// Mean over the places that `group` names: the rays start from all of them in turn.
  float sky_seen(std::vector<Place> const& places, std::span<std::uint32_t const> group, float offset,
                 std::uint32_t pattern) const {
    std::size_t const starts = std::min(group.size(), rays_);
    std::size_t seen = 0;
    for (std::size_t s = 0; s < starts; ++s) {
      auto const [point, normal] = lookout(places[group[s * group.size() / starts]]);
      for (std::size_t i = s; i < rays_; i += starts) {
        V3f const direction = sky_direction(normal, int(i), int(rays_), pattern);
        seen += !scene_.occluded({point + normal * offset, direction});
      }
    }
    return float(seen) / float(rays_);
  }

 private:
  TriMesh const& mesh_;
  RayScene const& scene_;
  Surface const& surface_;
  std::size_t rays_;
};

/// Indices of the places that faces use, by cell, and where each cell's begin.
struct Groups {
  std::vector<std::uint32_t> order;
  std::vector<std::size_t> begins;  ///< and the end
};

Groups group(std::vector<Place> const& places) {
  Groups groups;
  for (std::uint32_t i = 0; i < places.size(); ++i)
    if (places[i].face != kNoFace) groups.order.push_back(i);
  std::sort(groups.order.begin(), groups.order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return places[a].cell != places[b].cell ? places[a].cell < places[b].cell : a < b;
  });
  for (std::size_t i = 0; i < groups.order.size(); ++i)
    if (i == 0 || places[groups.order[i]].cell != places[groups.order[i - 1]].cell) groups.begins.push_back(i);
  groups.begins.push_back(groups.order.size());
  return groups;
}

}  // namespace

OcclusionField::OcclusionField(TriMesh const& mesh, RayScene const& scene, Surface const& surface, int rays) {
  Box3f const box = bounds(mesh);
  float const diagonal = box.size().length();
  float cell = kCell * diagonal;
  cuts_ = cut_faces(mesh, cell);
  std::vector<Place> places = all_places(mesh, cuts_);
  Tracer const tracer(mesh, scene, surface, rays);
  Cells const cell_of(box, cell);
  parallel_for(places.size(), 4096, [&](std::size_t i) {
    if (places[i].face == kNoFace) return;
    auto const [point, normal] = tracer.lookout(places[i]);
    places[i].cell = cell_of(point, normal);
  });
  values_.assign(places.size(), 65535);
  Groups const groups = group(places);
  parallel_for(groups.begins.size() - 1, 64, [&](std::size_t g) {
    std::span const members(&groups.order[groups.begins[g]], groups.begins[g + 1] - groups.begins[g]);
    float const seen = tracer.sky_seen(places, members, kOffset * diagonal, static_cast<std::uint32_t>(g));
    for (std::uint32_t i : members) values_[i] = static_cast<std::uint16_t>(std::lround(seen * 65535));
  });
}

float OcclusionField::at(TriMesh const& mesh, Hit const& hit) const {
  auto const cut = std::lower_bound(cuts_.begin(), cuts_.end(), hit.face,
                                    [](Cut const& c, std::uint32_t face) { return c.face < face; });
  Triangle const& t = mesh.triangles[hit.face];
  if (cut == cuts_.end() || cut->face != hit.face) return between({t[0], t[1], t[2]}, hit.u, hit.v);
  float const steps = float(cut->steps), u = std::clamp(hit.u, 0.f, 1.f) * steps;
  float const v = std::clamp(hit.v, 0.f, 1.f - u / steps) * steps;
  std::size_t const column = std::min(std::size_t(u), std::size_t(cut->steps - 1));
  std::size_t const row = std::min(std::size_t(v), cut->steps - 1 - column);
  auto const place = [&](std::size_t c, std::size_t r) { return cut->first + place_in_cut(cut->steps, c, r); };
  float const x = u - float(column), y = v - float(row);
  if (x + y <= 1 || column + row + 2 > cut->steps)
    return between({place(column, row), place(column + 1, row), place(column, row + 1)}, x, y);
  return between({place(column + 1, row + 1), place(column, row + 1), place(column + 1, row)}, 1 - x, 1 - y);
}

float OcclusionField::between(std::array<std::size_t, 3> const& places, float u, float v) const {
  return interpolate(float(values_[places[0]]), float(values_[places[1]]), float(values_[places[2]]),
                     Barycentric{u, v}) /
         65535;
}

}  // namespace vitrine
