// SPDX-License-Identifier: Apache-2.0
#include "io/plain_glb.h"

#include "io/gltf_compression.h"
#include "io/gltf_file.h"
#include "io/gltf_geometry.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

namespace vitrine::io {
namespace {

constexpr char kDraco[] = "KHR_draco_mesh_compression";
constexpr int kPositionBits = 16, kNormalBits = 8;

GltfJson const& only_primitive(GltfFile const& gltf) {
  GltfJson const* const primitives = member(gltf.item("meshes", 0), "primitives");
  if (!primitives || !primitives->is_array() || primitives->size() != 1) refuse_gltf("a thumbnail has one primitive");
  return primitives->front();
}

/// The attribute as Draco decoded it; empty where the primitive has none of that name.
template <class Vector>
std::vector<Vector> take(DracoGeometry const& decoded, GltfJson const& ids, char const* name) {
  std::optional<std::uint64_t> const id = whole(ids, name);
  if (!id) return {};
  ComponentArray const& array = decoded.attributes.at(*id);
  if (array.components != Vector::dimensions()) refuse_gltf(std::string("attribute ") + name + " has another shape");
  std::vector<float> const values = to_floats(array);
  std::vector<Vector> out(array.count);
  for (std::size_t i = 0; i < values.size(); ++i)
    out[i / array.components][static_cast<int>(i % array.components)] = values[i];
  return out;
}

VertexMesh decode(GltfFile& gltf, GltfJson const& draco) {
  GltfJson const* const ids = member(draco, "attributes");
  if (!ids || !ids->is_object()) refuse_gltf("a Draco primitive without attributes");
  std::vector<std::uint64_t> wanted;
  for (auto const& [name, id] : ids->items()) wanted.push_back(required(*ids, name.c_str()));
  DracoGeometry const decoded = decode_draco(gltf.view(required(draco, "bufferView")).bytes, wanted, gltf.limits());
  VertexMesh mesh;
  mesh.positions = take<V3f>(decoded, *ids, "POSITION");
  mesh.normals = take<V3f>(decoded, *ids, "NORMAL");
  mesh.tangents = take<V4f>(decoded, *ids, "TANGENT");
  mesh.uvs = take<V2f>(decoded, *ids, "TEXCOORD_0");
  mesh.colours = take<V3f>(decoded, *ids, "COLOR_0");
  for (std::size_t i = 0; i + 2 < decoded.indices.size(); i += 3)
    mesh.triangles.push_back({decoded.indices[i], decoded.indices[i + 1], decoded.indices[i + 2]});
  if (mesh.positions.empty() || mesh.triangles.empty()) refuse_gltf("a thumbnail without triangles");
  return mesh;
}

Grid grid_around(VertexMesh const& mesh) {
  Box3f box;
  for (V3f const& p : mesh.positions) box.extendBy(p);
  V3f const size = box.size();
  float const longest = std::max({size.x, size.y, size.z});
  Grid grid;
  grid.origin = box.min;
  grid.range = longest > 0 ? longest : 1;
  grid.position_bits = kPositionBits;
  grid.normal_bits = kNormalBits;
  return grid;
}

/// Everything but the geometry, which has been written already: the views of coded maps follow its own.
void copy_rest(GltfDocument& to, GltfFile& gltf) {
  GltfJson const& root = gltf.root();
  for (char const* key : {"scene", "scenes", "materials", "textures", "samplers", "images"})
    if (GltfJson const* const value = member(root, key)) to.json[key] = *value;
  if (to.json.contains("images"))
    for (Json& image : to.json["images"]) {
      std::uint64_t const view = required(GltfJson(image), "bufferView");
      image["bufferView"] = to.add_view(gltf.view(view).bytes);
    }
  for (GltfJson const& name : root.value("extensionsUsed", GltfJson::array())) {
    GltfJson const needed = root.value("extensionsRequired", GltfJson::array());
    bool const required_too = std::find(needed.begin(), needed.end(), name) != needed.end();
    if (name != kDraco) to.use_extension(name.get<std::string>(), required_too ? Need::required : Need::optional);
  }
}

/// The node's own place, and that of the grid in it.
Json node_of(GltfFile const& gltf, WrittenGeometry const& geometry) {
  Json node = gltf.item("nodes", 0);
  std::array<double, 3> place{0, 0, 0};
  if (node.contains("translation")) place = node["translation"].get<std::array<double, 3>>();
  V3d const translation = V3d(place[0], place[1], place[2]) + V3d(geometry.translation);
  node["translation"] = numbers(translation);
  node["scale"] = numbers(V3f(geometry.scale));
  return node;
}

}  // namespace

std::vector<std::byte> plain_glb(std::span<std::byte const> thumbnail) try {
  Resolve const nothing = [](std::string_view) { return std::optional<Blob>(); };
  ReadLimits const limits;
  GltfFile gltf(Blob{thumbnail, nullptr}, nothing, limits);
  GltfJson const& source = only_primitive(gltf);
  GltfJson const* const draco = extension(source, kDraco);
  if (!draco) return {};
  VertexMesh const mesh = decode(gltf, *draco);
  GltfDocument document;
  WrittenGeometry const geometry = write_buffers(document, mesh, grid_around(mesh));
  copy_rest(document, gltf);
  document.json["nodes"] = Json::array({node_of(gltf, geometry)});
  Json primitive = geometry.primitive;
  primitive["material"] = 0;
  document.json["meshes"][0]["primitives"] = Json::array({std::move(primitive)});
  return document.glb();
} catch (nlohmann::json::exception const& e) {
  refuse_gltf(e.what());
}

}  // namespace vitrine::io
