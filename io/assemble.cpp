// SPDX-License-Identifier: Apache-2.0
#include "io/assemble.h"

#include "io/first_use.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace vitrine::io {
namespace {

constexpr std::uint64_t kMostVertices =
    std::numeric_limits<std::uint32_t>::max() - 1;  ///< that 32-bit indices can name

bool finite(V3d const& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

/// The box's middle when the box lies more than 16 of its diagonals from zero: floats then keep fewer than 20 bits of
/// it.
V3d far_origin(std::span<V3d const> positions) {
  Imath::Box3d box;
  for (V3d const& p : positions)
    if (finite(p)) box.extendBy(p);
  if (box.isEmpty()) return {0, 0, 0};
  V3d const middle = box.min + (box.max - box.min) * 0.5;
  return middle.length() > 16 * (box.max - box.min).length() ? middle : V3d(0, 0, 0);
}

/// A vertex after splitting. Bits, so that a corner always equals itself.
struct Corner {
  std::uint32_t vertex = 0;
  std::array<std::uint32_t, 2> uv{};
  Rgba16 colour{};
  bool operator==(Corner const&) const = default;
};

Corner corner_of(TriMesh const& mesh, CornerAttributes const& corners, std::size_t face, std::size_t corner) {
  Corner result{.vertex = mesh.triangles[face][corner]};
  if (!corners.uvs.empty()) {
    V2f const& uv = corners.uvs[face][corner];
    result.uv = {std::bit_cast<std::uint32_t>(uv.x), std::bit_cast<std::uint32_t>(uv.y)};
  }
  if (!corners.face_colours.empty()) result.colour = corners.face_colours[face];
  return result;
}

template <class T>
void gather(std::vector<T>& values, std::vector<Corner> const& from) {
  if (values.empty()) return;
  std::vector<T> gathered(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) gathered[i] = values[from[i].vertex];
  values = std::move(gathered);
}

void refuse_above(std::uint64_t limit, std::uint64_t value, std::string const& unit) {
  if (value > limit)
    throw Error(ErrorKind::limit_exceeded,
                std::to_string(value) + " " + unit + " exceed the limit of " + std::to_string(limit),
                "simplify or cut the model before");
}

}  // namespace

std::uint64_t bytes_of(SourceModel const& model) {
  return model.mesh.positions.size() * sizeof(V3f) + model.mesh.triangles.size() * sizeof(Triangle) +
         model.normals.size() * sizeof(V3f) + model.tangents.size() * sizeof(V4f) + model.uvs.size() * sizeof(V2f) +
         model.colours.size() * sizeof(Rgba16);
}

V3f unit_or_zero(V3d const& v) {
  double const length = v.length();
  return length > 0 && std::isfinite(length) ? V3f(v / length) : V3f(0, 0, 0);
}

Error no_faces(std::string const& format, std::uint64_t vertices) {
  return Error(ErrorKind::unsupported,
               "the " + format + " file has no faces, " + std::to_string(vertices) + " points alone",
               "make a surface of the points first, or leave the file out");
}

void check_limits(ReadLimits const& limits, std::uint64_t vertices, std::uint64_t triangles, std::uint64_t bytes) {
  refuse_above(std::min<std::uint64_t>(limits.vertices, kMostVertices), vertices, "vertices");
  refuse_above(limits.triangles, triangles, "triangles");
  refuse_above(limits.bytes, bytes, "bytes of vertices and triangles");
}

void place(SourceModel& model, std::span<V3d const> positions) {
  model.origin = far_origin(positions);
  model.mesh.positions.resize(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) model.mesh.positions[i] = V3f(positions[i] - model.origin);
}

void split_vertices(SourceModel& model, CornerAttributes const& attributes) {
  FirstUse<Corner> corners(model.mesh.positions.size());
  constexpr std::size_t kBlock = 1024;
  std::vector<Corner> keys;
  std::vector<Triangle>& triangles = model.mesh.triangles;
  for (std::size_t begin = 0; begin < triangles.size(); begin += kBlock) {
    std::size_t const end = std::min(triangles.size(), begin + kBlock);
    keys.clear();
    for (std::size_t f = begin; f < end; ++f)
      for (std::size_t c = 0; c < 3; ++c) keys.push_back(corner_of(model.mesh, attributes, f, c));
    corners.number(keys, {triangles[begin].data(), keys.size()});
  }
  gather(model.mesh.positions, corners.keys());
  gather(model.normals, corners.keys());
  gather(model.colours, corners.keys());
  gather(model.uvs, corners.keys());
  if (!attributes.uvs.empty()) {
    model.uvs.clear();
    for (Corner const& corner : corners.keys())
      model.uvs.emplace_back(std::bit_cast<float>(corner.uv[0]), std::bit_cast<float>(corner.uv[1]));
  }
  if (!attributes.face_colours.empty()) {
    model.colours.clear();
    for (Corner const& corner : corners.keys()) model.colours.push_back(corner.colour);
  }
}

}  // namespace vitrine::io
