// SPDX-License-Identifier: Apache-2.0
#include "stages/quantize.h"

#include "stages/error.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>

namespace vitrine {
namespace {

using Imath::V3i;
using V3l = Imath::Vec3<std::int64_t>;

/// Exact, as the codes are integers.
bool has_area(V3i const& a, V3i const& b, V3i const& c) { return V3l(b - a).cross(V3l(c - a)) != V3l(0); }

/// For each vertex, the first one with the same code.
std::vector<std::uint32_t> first_at_place(std::vector<V3i> const& codes) {
  std::vector<std::uint32_t> order(codes.size()), first(codes.size());
  std::iota(order.begin(), order.end(), 0u);
  auto const key = [&](std::uint32_t v) { return std::tuple(codes[v].x, codes[v].y, codes[v].z, v); };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  for (std::size_t i = 0; i < order.size(); ++i)
    first[order[i]] = i > 0 && codes[order[i]] == codes[order[i - 1]] ? first[order[i - 1]] : order[i];
  return first;
}

/// Keeps the faces that still have an area, joins vertices that met and numbers them by first use. Returns the kept.
std::vector<std::size_t> rebuild(TriMesh& mesh, std::vector<V3i> const& codes) {
  constexpr std::uint32_t kUnused = 0xffffffffu;
  std::vector<std::uint32_t> const place = first_at_place(codes);
  std::vector<std::uint32_t> number(codes.size(), kUnused);
  std::vector<V3f> positions;
  std::vector<std::size_t> kept;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    Triangle face = mesh.triangles[f];
    if (!has_area(codes[face[0]], codes[face[1]], codes[face[2]])) continue;
    for (std::uint32_t& corner : face) {
      std::uint32_t const vertex = place[corner];
      if (number[vertex] == kUnused) {
        number[vertex] = std::uint32_t(positions.size());
        positions.push_back(mesh.positions[vertex]);
      }
      corner = number[vertex];
    }
    mesh.triangles[kept.size()] = face;
    kept.push_back(f);
  }
  if (kept.empty())
    throw Error(ErrorKind::no_solution, "no face is as large as a step of the grid", "use more --position-bits");
  mesh.triangles.resize(kept.size());
  mesh.positions = std::move(positions);
  return kept;
}

std::vector<V3i> snap(TriMesh& mesh, GridCodes const& grid) {
  std::vector<V3i> codes;
  codes.reserve(mesh.positions.size());
  for (V3f& position : mesh.positions) {
    codes.push_back(grid.code(position));
    position = grid.value(codes.back());
  }
  return codes;
}

/// The entries of the faces that are kept.
template <class T>
void keep(std::vector<T>& values, std::vector<std::size_t> const& kept) {
  for (std::size_t i = 0; i < kept.size(); ++i) values[i] = values[kept[i]];
  values.resize(kept.size());
}

/// Snapping moves each of two charts by up to half a step: together they must not cross the gutter.
void require_fine_uvs(Atlas const& atlas, int bits) {
  double const steps = std::pow(2, bits) - 1;
  double const texels = std::max(atlas.width, atlas.height) / steps;
  if (atlas.charts > 1 && texels > atlas.gutter)
    throw Error(ErrorKind::limit_exceeded,
                std::to_string(bits) + " uv bits move charts by " + std::to_string(texels) +
                    " texels, the gutter has " + std::to_string(atlas.gutter),
                "use more --uv-bits or a smaller texture");
}

/// Unit vector of a code, counted from the square's centre, in the decoder's float arithmetic.
V3f decode_octahedral(int s, int t, int centre) {
  float const step = 2.f / float(2 * centre);
  float y = float(s + centre) * step - 1.f, z = float(t + centre) * step - 1.f;
  float const x = 1.f - std::abs(y) - std::abs(z), fold = std::max(-x, 0.f);
  y += y < 0 ? fold : -fold;
  z += z < 0 ? fold : -fold;
  float const scale = 1.f / std::sqrt(x * x + y * y + z * z);
  return {x * scale, y * scale, z * scale};
}

}  // namespace

Grid cube_about(TriMesh const& mesh, int position_bits) {
  Box3f const box = bounds(mesh);
  V3f const size = box.size();
  Grid grid;
  grid.origin = box.min;
  grid.range = std::max({size.x, size.y, size.z});
  grid.position_bits = position_bits;
  if (!(grid.range > 0)) throw Error(ErrorKind::no_solution, "the mesh has no extent", "check the model in a viewer");
  return grid;
}

QuantizedMesh quantize(TriMesh mesh, Grid const& grid) {
  rebuild(mesh, snap(mesh, GridCodes(grid)));
  return {std::move(mesh), grid};
}

QuantizedAtlas quantize(Atlas atlas, QuantizeOptions const& options) {
  require_fine_uvs(atlas, options.uv_bits);
  Grid grid = cube_about(atlas.mesh, options.position_bits);
  grid.uv_bits = options.uv_bits;
  grid.normal_bits = options.normal_bits;
  AxisCodes const unit(0, 1, grid.uv_bits);
  for (CornerUvs& corners : atlas.corner_uvs)
    for (V2f& uv : corners) uv = {unit.value(unit.code(uv.x)), unit.value(unit.code(uv.y))};
  std::vector<std::size_t> const kept = rebuild(atlas.mesh, snap(atlas.mesh, GridCodes(grid)));
  keep(atlas.face_charts, kept);
  keep(atlas.corner_uvs, kept);
  return {std::move(atlas), grid};
}

V3f quantize_normal(V3f const& normal, int bits) {
  int const centre = (1 << (bits - 1)) - 1;
  V3d const n(normal);
  double const length = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
  V3d const octahedral = length > 1e-6 ? n / length : V3d(1, 0, 0);
  auto const round = [&](double share) { return int(std::floor(share * centre + 0.5)); };
  // Integers whose absolute values add up to `centre`: a place on the octahedron, sign and all.
  int const x = round(octahedral.x);
  int y = round(octahedral.y), z = centre - std::abs(x) - std::abs(y);
  if (z < 0) {
    y += y > 0 ? z : -z;
    z = 0;
  }
  if (octahedral.z < 0) z = -z;
  // The code, from the square's centre: the half with x < 0 is folded outwards; along the square's border two codes
  // mean the same place, and Draco takes the one whose coordinates have equal signs.
  auto const outside = [&](int along, int other) { return (along < 0 ? -1 : 1) * (centre - std::abs(other)); };
  int s = x < 0 ? outside(y, z) : y, t = x < 0 ? outside(z, y) : z;
  if (std::abs(s) == centre && std::abs(t) == centre)
    s = t = centre;
  else if (std::abs(s) == centre)
    t = s < 0 ? -std::abs(t) : std::abs(t);
  else if (std::abs(t) == centre)
    s = t < 0 ? -std::abs(s) : std::abs(s);
  return decode_octahedral(s, t, centre);
}

}  // namespace vitrine
