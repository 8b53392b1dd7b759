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

/// One coordinate's codes 0 ... 2^bits - 1 over [origin, origin + range]. Draco computes in float, so do we.
struct Scale {
  float origin, range;
  int codes;

  Scale(float from, float length, int bits) : origin(from), range(length), codes((1 << bits) - 1) {}
  int code(float value) const {
    float const inverse_step = float(codes) / range;
    return std::clamp(int(std::floor((value - origin) * inverse_step + 0.5f)), 0, codes);
  }
  float value(int code) const { return float(code) * (range / float(codes)) + origin; }
};

Grid cube_about(TriMesh const& mesh, QuantizeOptions const& options) {
  Box3f const box = bounds(mesh);
  V3f const size = box.size();
  float const range = std::max({size.x, size.y, size.z});
  if (!(range > 0)) throw Error(ErrorKind::no_solution, "the mesh has no extent", "check the model in a viewer");
  return {box.min, range, options.position_bits, options.uv_bits, options.normal_bits};
}

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

/// Keeps the faces that still have an area, joins vertices that met and numbers them by first use.
void rebuild(Atlas& atlas, std::vector<V3i> const& codes) {
  constexpr std::uint32_t kUnused = 0xffffffffu;
  std::vector<std::uint32_t> const place = first_at_place(codes);
  std::vector<std::uint32_t> number(codes.size(), kUnused);
  std::vector<V3f> positions;
  std::size_t kept = 0;
  for (std::size_t f = 0; f < atlas.mesh.triangles.size(); ++f) {
    Triangle face = atlas.mesh.triangles[f];
    if (!has_area(codes[face[0]], codes[face[1]], codes[face[2]])) continue;
    for (std::uint32_t& corner : face) {
      std::uint32_t const vertex = place[corner];
      if (number[vertex] == kUnused) {
        number[vertex] = std::uint32_t(positions.size());
        positions.push_back(atlas.mesh.positions[vertex]);
      }
      corner = number[vertex];
    }
    atlas.mesh.triangles[kept] = face;
    atlas.face_charts[kept] = atlas.face_charts[f];
    atlas.corner_uvs[kept] = atlas.corner_uvs[f];
    ++kept;
  }
  if (kept == 0)
    throw Error(ErrorKind::no_solution, "no face is as large as a step of the grid", "use more --position-bits");
  atlas.mesh.triangles.resize(kept);
  atlas.face_charts.resize(kept);
  atlas.corner_uvs.resize(kept);
  atlas.mesh.positions = std::move(positions);
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

QuantizedAtlas quantize(Atlas atlas, QuantizeOptions const& options) {
  require_fine_uvs(atlas, options.uv_bits);
  Grid const grid = cube_about(atlas.mesh, options);
  std::array<Scale, 3> const axes{Scale{grid.origin.x, grid.range, grid.position_bits},
                                  Scale{grid.origin.y, grid.range, grid.position_bits},
                                  Scale{grid.origin.z, grid.range, grid.position_bits}};
  std::vector<V3i> codes(atlas.mesh.positions.size());
  for (std::size_t v = 0; v < codes.size(); ++v)
    for (int k = 0; k < 3; ++k) {
      float& coordinate = atlas.mesh.positions[v][k];
      codes[v][k] = axes[k].code(coordinate);
      coordinate = axes[k].value(codes[v][k]);
    }
  Scale const unit{0, 1, grid.uv_bits};
  for (CornerUvs& corners : atlas.corner_uvs)
    for (V2f& uv : corners) uv = {unit.value(unit.code(uv.x)), unit.value(unit.code(uv.y))};
  rebuild(atlas, codes);
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
