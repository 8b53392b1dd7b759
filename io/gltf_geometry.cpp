// SPDX-License-Identifier: Apache-2.0
#include "io/gltf_geometry.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <string_view>
#include <utility>

namespace vitrine::io {
namespace {

static_assert(std::endian::native == std::endian::little, "buffers are written as they lie in memory");

// glTF's names for what accessors hold.
constexpr int kByte = 5120, kUnsignedByte = 5121, kShort = 5122, kUnsignedShort = 5123, kUnsignedInt = 5125,
              kFloat = 5126;
constexpr char kColours[] = "COLOR_0";

std::size_t index_size(std::size_t vertices) { return vertices <= 65535 ? 2 : 4; }

Json index_accessor(std::size_t vertices, std::size_t triangles) {
  return {{"componentType", index_size(vertices) == 2 ? kUnsignedShort : kUnsignedInt},
          {"count", 3 * triangles},
          {"type", "SCALAR"}};
}

// ---- Draco
// ------------------------------------------------------------------------------------------------------------

/// The box's corner rounded outwards to a power of ten below a thousandth of `range`.
Json rounded_bound(V3f const& corner, double range, double (*round)(double)) {
  double const per_unit = std::pow(10, -std::floor(std::log10(range / 1000)));
  Json list = Json::array();
  for (unsigned k = 0; k < 3; ++k) list.push_back(number(round(corner[k] * per_unit) / per_unit));
  return list;
}

// ---- Quantised buffers
// ------------------------------------------------------------------------------------------------

/// Triangles so that neighbours follow each other, vertices in the order of first use.
VertexMesh in_cache_order(VertexMesh const& mesh) {
  std::size_t const n = mesh.positions.size(), corners = 3 * mesh.triangles.size();
  VertexMesh out = mesh;
  unsigned* const indices = out.triangles.front().data();
  meshopt_optimizeVertexCacheStrip(indices, mesh.triangles.front().data(), corners, n);
  std::vector<unsigned> remap(n);
  meshopt_optimizeVertexFetchRemap(remap.data(), indices, corners, n);
  meshopt_remapIndexBuffer(indices, indices, corners, remap.data());
  auto reorder = [&](auto& to, auto const& from) {
    if (!from.empty()) meshopt_remapVertexBuffer(to.data(), from.data(), n, sizeof from[0], remap.data());
  };
  reorder(out.positions, mesh.positions);
  reorder(out.normals, mesh.normals);
  reorder(out.tangents, mesh.tangents);
  reorder(out.uvs, mesh.uvs);
  reorder(out.colours, mesh.colours);
  return out;
}

template <class Integer>
void put(std::byte* to, double value) {
  using Limits = std::numeric_limits<Integer>;
  auto const integer = static_cast<Integer>(std::lround(std::clamp<double>(value, Limits::min(), Limits::max())));
  std::memcpy(to, &integer, sizeof integer);
}

double position_step(Grid const& grid) { return grid.range / static_cast<float>((1 << grid.position_bits) - 1); }

/// Interleaved vertices; each attribute at a multiple of 4 bytes, as glTF wants.
struct VertexBuffer {
  std::vector<std::byte> bytes;
  std::size_t stride = 8, normal_at = 0, tangent_at = 0, uv_at = 0, colour_at = 0;
  bool short_normals = false, floats = false;  ///< floats: all but colours
};

VertexBuffer quantize(VertexMesh const& mesh, Grid const& grid) {
  VertexBuffer buffer;
  buffer.short_normals = grid.normal_bits > 8;
  if (!mesh.normals.empty())
    buffer.normal_at = std::exchange(buffer.stride, buffer.stride + (buffer.short_normals ? 8 : 4));
  if (!mesh.tangents.empty()) buffer.tangent_at = std::exchange(buffer.stride, buffer.stride + 4);
  if (!mesh.uvs.empty()) buffer.uv_at = std::exchange(buffer.stride, buffer.stride + 4);
  if (!mesh.colours.empty()) buffer.colour_at = std::exchange(buffer.stride, buffer.stride + 4);
  buffer.bytes.resize(mesh.positions.size() * buffer.stride);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    std::byte* const vertex = buffer.bytes.data() + i * buffer.stride;
    V3d const steps = (V3d(mesh.positions[i]) - V3d(grid.origin)) / position_step(grid);
    for (unsigned k = 0; k < 3; ++k) put<std::uint16_t>(vertex + 2 * k, steps[k]);
    for (unsigned k = 0; k < 3 && !mesh.normals.empty(); ++k) {
      std::byte* const normal = vertex + buffer.normal_at;
      if (buffer.short_normals)
        put<std::int16_t>(normal + 2 * k, 32767.0 * mesh.normals[i][k]);
      else
        put<std::int8_t>(normal + k, 127.0 * mesh.normals[i][k]);
    }
    for (unsigned k = 0; k < 4 && !mesh.tangents.empty(); ++k)
      put<std::int8_t>(vertex + buffer.tangent_at + k, 127.0 * mesh.tangents[i][k]);
    for (unsigned k = 0; k < 2 && !mesh.uvs.empty(); ++k)
      put<std::uint16_t>(vertex + buffer.uv_at + 2 * k, 65535.0 * mesh.uvs[i][k]);
    for (unsigned k = 0; k < 3 && !mesh.colours.empty(); ++k)
      put<std::uint8_t>(vertex + buffer.colour_at + k, 255.0 * mesh.colours[i][k]);
  }
  return buffer;
}

/// The same as floats, which need no extension and stand where they are.
VertexBuffer as_floats(VertexMesh const& mesh) {
  VertexBuffer buffer;
  buffer.floats = true;
  buffer.stride = 12;
  if (!mesh.normals.empty()) buffer.normal_at = std::exchange(buffer.stride, buffer.stride + 12);
  if (!mesh.tangents.empty()) buffer.tangent_at = std::exchange(buffer.stride, buffer.stride + 16);
  if (!mesh.uvs.empty()) buffer.uv_at = std::exchange(buffer.stride, buffer.stride + 8);
  if (!mesh.colours.empty()) buffer.colour_at = std::exchange(buffer.stride, buffer.stride + 4);
  buffer.bytes.resize(mesh.positions.size() * buffer.stride);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    std::byte* const vertex = buffer.bytes.data() + i * buffer.stride;
    auto const copy = [&](std::size_t at, auto const& from) {
      if (!from.empty()) std::memcpy(vertex + at, &from[i], sizeof from[i]);
    };
    copy(0, mesh.positions);
    copy(buffer.normal_at, mesh.normals);
    copy(buffer.tangent_at, mesh.tangents);
    copy(buffer.uv_at, mesh.uvs);
    for (unsigned k = 0; k < 3 && !mesh.colours.empty(); ++k)
      put<std::uint8_t>(vertex + buffer.colour_at + k, 255.0 * mesh.colours[i][k]);
  }
  return buffer;
}

std::vector<std::byte> index_buffer(VertexMesh const& mesh) {
  std::size_t const size = index_size(mesh.positions.size());
  std::vector<std::byte> bytes(3 * size * mesh.triangles.size());
  std::byte* to = bytes.data();
  for (Triangle const& triangle : mesh.triangles)
    for (std::uint32_t index : triangle) std::memcpy(std::exchange(to, to + size), &index, size);
  return bytes;
}

/// Accessors and primitive for interleaved vertices in view 0 and indices in view 1.
WrittenGeometry describe(GltfDocument& document, VertexMesh const& mesh, VertexBuffer const& buffer, Grid const& grid) {
  std::size_t const n = mesh.positions.size();
  WrittenGeometry written;
  if (!buffer.floats) {
    written.translation = grid.origin;
    written.scale = static_cast<float>(position_step(grid));
    document.use_extension("KHR_mesh_quantization", Need::required);
  }
  written.vertices = static_cast<std::uint32_t>(n);
  written.triangles = static_cast<std::uint32_t>(mesh.triangles.size());
  auto attribute = [&](char const* name, std::size_t at, int type, bool normalized, char const* shape) {
    Json accessor = {{"bufferView", 0}};
    if (at > 0) accessor["byteOffset"] = at;
    bool const floats = buffer.floats && std::string_view(name) != kColours;
    accessor["componentType"] = floats ? kFloat : type;
    if (normalized && !floats) accessor["normalized"] = true;
    accessor["count"] = n;
    accessor["type"] = shape;
    written.primitive["attributes"][name] = add(document.json, "accessors", std::move(accessor));
  };
  attribute("POSITION", 0, kUnsignedShort, false, "VEC3");
  Box3f box;
  for (V3f const& p : mesh.positions) box.extendBy(p);
  auto const stored = [&](V3f const& p, unsigned k) -> Json {
    if (buffer.floats) return number(p[k]);
    return std::lround((double(p[k]) - grid.origin[k]) / position_step(grid));
  };
  for (unsigned k = 0; k < 3; ++k) {
    document.json["accessors"][0]["min"].push_back(stored(box.min, k));
    document.json["accessors"][0]["max"].push_back(stored(box.max, k));
  }
  if (buffer.normal_at > 0) attribute("NORMAL", buffer.normal_at, buffer.short_normals ? kShort : kByte, true, "VEC3");
  if (buffer.tangent_at > 0) attribute("TANGENT", buffer.tangent_at, kByte, true, "VEC4");
  if (buffer.uv_at > 0) attribute("TEXCOORD_0", buffer.uv_at, kUnsignedShort, true, "VEC2");
  if (buffer.colour_at > 0) attribute(kColours, buffer.colour_at, kUnsignedByte, true, "VEC3");
  Json indices = {{"bufferView", 1}};
  indices.update(index_accessor(n, mesh.triangles.size()));
  written.primitive["indices"] = add(document.json, "accessors", std::move(indices));
  return written;
}

WrittenGeometry write_views(GltfDocument& document, VertexMesh const& mesh, VertexBuffer const& vertices,
                            Grid const& grid) {
  std::vector<std::byte> const indices = index_buffer(mesh);
  document.add_view(vertices.bytes, {{"byteStride", vertices.stride}});
  document.add_view(indices);
  WrittenGeometry written = describe(document, mesh, vertices, grid);
  written.bytes = vertices.bytes.size() + indices.size();
  return written;
}

/// A view of coded bytes that stands for `count` elements of `stride` bytes at `offset` of the buffer that is never
/// there.
void add_meshopt_view(GltfDocument& document, std::span<std::byte const> coded, char const* mode, std::size_t offset,
                      std::size_t count, std::size_t stride) {
  Json extension = {{"buffer", 0}};
  if (std::size_t const at = document.append(coded); at > 0) extension["byteOffset"] = at;
  extension.update({{"byteLength", coded.size()}, {"byteStride", stride}, {"count", count}, {"mode", mode}});
  Json view = {{"buffer", 1}};
  if (offset > 0) view["byteOffset"] = offset;
  view["byteLength"] = count * stride;
  if (stride >= 4 && offset == 0) view["byteStride"] = stride;
  view["extensions"]["EXT_meshopt_compression"] = std::move(extension);
  add(document.json, "bufferViews", std::move(view));
}

}  // namespace

WrittenGeometry write_draco(GltfDocument& document, VertexMesh const& mesh, Grid const& grid) {
  DracoMesh const coded = encode_draco(mesh, grid);
  WrittenGeometry written;
  written.bytes = coded.bytes.size();
  written.vertices = coded.vertices;
  written.triangles = coded.triangles;
  Json ids;
  auto attribute = [&](char const* name, int id, char const* shape) {
    ids[name] = id;
    written.primitive["attributes"][name] =
        add(document.json, "accessors", {{"componentType", kFloat}, {"count", coded.vertices}, {"type", shape}});
  };
  attribute("POSITION", coded.position_id, "VEC3");
  Box3f box;
  for (V3f const& p : mesh.positions) box.extendBy(p);
  document.json["accessors"][0]["min"] = rounded_bound(box.min, grid.range, std::floor);
  document.json["accessors"][0]["max"] = rounded_bound(box.max, grid.range, std::ceil);
  if (coded.normal_id >= 0) attribute("NORMAL", coded.normal_id, "VEC3");
  if (coded.tangent_id >= 0) attribute("TANGENT", coded.tangent_id, "VEC4");
  if (coded.uv_id >= 0) attribute("TEXCOORD_0", coded.uv_id, "VEC2");
  if (coded.colour_id >= 0) attribute("COLOR_0", coded.colour_id, "VEC3");
  written.primitive["indices"] = add(document.json, "accessors", index_accessor(coded.vertices, coded.triangles));
  document.use_extension("KHR_draco_mesh_compression", Need::required);
  written.primitive["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", document.add_view(coded.bytes)},
                                                                   {"attributes", std::move(ids)}};
  return written;
}

WrittenGeometry write_buffers(GltfDocument& document, VertexMesh const& unordered, Grid const& grid) {
  VertexMesh const mesh = in_cache_order(unordered);
  return write_views(document, mesh, quantize(mesh, grid), grid);
}

WrittenGeometry write_floats(GltfDocument& document, VertexMesh const& unordered) {
  VertexMesh const mesh = in_cache_order(unordered);
  return write_views(document, mesh, as_floats(mesh), {});
}

WrittenGeometry write_meshopt(GltfDocument& document, VertexMesh const& unordered, Grid const& grid) {
  VertexMesh const mesh = in_cache_order(unordered);
  VertexBuffer const vertices = quantize(mesh, grid);
  std::size_t const n = mesh.positions.size(), corners = 3 * mesh.triangles.size();
  std::vector<std::byte> coded(meshopt_encodeVertexBufferBound(n, vertices.stride));
  coded.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(coded.data()), coded.size(),
                                          vertices.bytes.data(), n, vertices.stride));
  add_meshopt_view(document, coded, "ATTRIBUTES", 0, n, vertices.stride);
  std::size_t const vertex_bytes = coded.size();
  [[maybe_unused]] static bool const once = (meshopt_encodeIndexVersion(1), true);  // the one that the extension knows
  coded.resize(meshopt_encodeIndexBufferBound(corners, n));
  coded.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(coded.data()), coded.size(),
                                         mesh.triangles.front().data(), corners));
  add_meshopt_view(document, coded, "TRIANGLES", vertices.bytes.size(), corners, index_size(n));
  document.use_extension("EXT_meshopt_compression", Need::required);
  document.json["buffers"][1] = {{"byteLength", vertices.bytes.size() + corners * index_size(n)},
                                 {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}};
  WrittenGeometry written = describe(document, mesh, vertices, grid);
  written.bytes = vertex_bytes + coded.size();
  return written;
}

}  // namespace vitrine::io
