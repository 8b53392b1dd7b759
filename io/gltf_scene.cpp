// SPDX-License-Identifier: Apache-2.0
#include "io/gltf_scene.h"

#include "io/gltf_accessors.h"

#include <Imath/ImathQuat.h>

#include <map>
#include <utility>

namespace vitrine::io {
namespace {

M44d as_matrix(std::array<double, 16> const& m) {
  // glTF stores columns of a matrix that multiplies columns, Imath rows of one that multiplies rows: the same sixteen
  // numbers.
  return {m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8], m[9], m[10], m[11], m[12], m[13], m[14], m[15]};
}

M44d transform(std::array<double, 3> const& t, std::array<double, 4> const& r, std::array<double, 3> const& s) {
  M44d scale, translation;
  scale.setScale(V3d(s[0], s[1], s[2]));
  translation.setTranslation(V3d(t[0], t[1], t[2]));
  return scale * Imath::Quatd(r[3], r[0], r[1], r[2]).normalized().toMatrix44() * translation;
}

M44d local_transform(GltfJson const& node) {
  if (member(node, "matrix")) return as_matrix(reals<16>(node, "matrix", {}));
  return transform(reals<3>(node, "translation", {0, 0, 0}), reals<4>(node, "rotation", {0, 0, 0, 1}),
                   reals<3>(node, "scale", {1, 1, 1}));
}

/// Numbers of an instancing attribute; `otherwise` for each instance when it is absent.
std::vector<float> instance_attribute(GltfFile& gltf, GltfJson const& attributes, char const* name,
                                      std::size_t components) {
  std::optional<std::uint64_t> const accessor = whole(attributes, name);
  if (!accessor) return {};
  ComponentArray const array = read_accessor(gltf, *accessor);
  if (array.components != components)
    refuse_gltf(std::string("instancing attribute ") + name + " has " + std::to_string(array.components) +
                " components");
  return to_floats(array);
}

/// Source: EXT_mesh_gpu_instancing.
std::vector<M44d> instance_transforms(GltfFile& gltf, GltfJson const& node) {
  GltfJson const* const instancing = extension(node, "EXT_mesh_gpu_instancing");
  GltfJson const* const attributes = instancing ? member(*instancing, "attributes") : nullptr;
  if (!attributes) return {M44d()};
  std::vector<float> const t = instance_attribute(gltf, *attributes, "TRANSLATION", 3);
  std::vector<float> const r = instance_attribute(gltf, *attributes, "ROTATION", 4);
  std::vector<float> const s = instance_attribute(gltf, *attributes, "SCALE", 3);
  std::size_t const count = std::max({t.size() / 3, r.size() / 4, s.size() / 3});
  for (auto const& [size, components] : {std::pair{t.size(), 3}, {r.size(), 4}, {s.size(), 3}})
    if (size != 0 && size != count * static_cast<std::size_t>(components))
      refuse_gltf("instancing attributes of different counts");
  std::vector<M44d> transforms;
  for (std::size_t i = 0; i < count; ++i)
    transforms.push_back(transform(
        t.empty() ? std::array<double, 3>{0, 0, 0} : std::array<double, 3>{t[3 * i], t[3 * i + 1], t[3 * i + 2]},
        r.empty() ? std::array<double, 4>{0, 0, 0, 1}
                  : std::array<double, 4>{r[4 * i], r[4 * i + 1], r[4 * i + 2], r[4 * i + 3]},
        s.empty() ? std::array<double, 3>{1, 1, 1} : std::array<double, 3>{s[3 * i], s[3 * i + 1], s[3 * i + 2]}));
  return transforms;
}

/// Walks the tree of one scene.
class Scene {
 public:
  explicit Scene(GltfFile& gltf) : gltf_(gltf) {}

  std::vector<MeshInstance> instances() {
    if (list(gltf_.root(), "scenes").empty()) refuse_gltf("it has no scene");
    GltfJson const& scene = gltf_.item("scenes", whole(gltf_.root(), "scene").value_or(0));
    visit_all(list(scene, "nodes"), M44d(), 0);
    std::vector<MeshInstance> result;
    for (std::uint64_t const node : order_) add_instances(node, result);
    return result;
  }

 private:
  void visit_all(GltfJson const& nodes, M44d const& parent, int depth) {
    if (depth > gltf_.limits().nesting)
      throw Error(ErrorKind::limit_exceeded,
                  "glTF: nodes nest deeper than the limit of " + std::to_string(gltf_.limits().nesting),
                  "flatten the scene before");
    for (GltfJson const& index : nodes) {
      if (!index.is_number_unsigned()) refuse_gltf("a node index is no whole number");
      auto const number = index.get<std::uint64_t>();
      GltfJson const& node = gltf_.item("nodes", number);
      M44d const world = local_transform(node) * parent;
      if (!worlds_.emplace(number, world).second)
        refuse_gltf("node " + std::to_string(number) + " is reached twice: the nodes are no tree");
      order_.push_back(number);
      visit_all(list(node, "children"), world, depth + 1);
    }
  }

  void add_instances(std::uint64_t number, std::vector<MeshInstance>& result) {
    GltfJson const& node = gltf_.item("nodes", number);
    std::optional<std::uint64_t> const mesh = whole(node, "mesh");
    if (!mesh) return;
    GltfJson const& owner = member(node, "weights") ? node : gltf_.item("meshes", *mesh);
    std::vector<double> weights;
    for (GltfJson const& weight : list(owner, "weights"))
      weights.push_back(weight.is_number() ? weight.get<double>() : 0);
    std::optional<std::uint64_t> const skin = whole(node, "skin");
    std::vector<M44d> const joints = skin ? joint_matrices(*skin) : std::vector<M44d>();
    for (M44d const& instance : instance_transforms(gltf_, node))
      result.push_back({*mesh, instance * worlds_.at(number), joints, weights});
  }

  std::vector<M44d> joint_matrices(std::uint64_t number) {
    GltfJson const& skin = gltf_.item("skins", number);
    GltfJson const& joints = list(skin, "joints");
    std::vector<float> inverse;
    if (std::optional<std::uint64_t> const accessor = whole(skin, "inverseBindMatrices")) {
      ComponentArray const array = read_accessor(gltf_, *accessor);
      if (array.components != 16 || array.count < joints.size())
        refuse_gltf(std::to_string(array.count) + " inverse bind matrices for " + std::to_string(joints.size()) +
                    " joints");
      inverse = to_floats(array);
    }
    std::vector<M44d> matrices;
    for (std::size_t j = 0; j < joints.size(); ++j) {
      auto const world =
          worlds_.find(joints[j].is_number_unsigned() ? joints[j].get<std::uint64_t>() : ~std::uint64_t{0});
      if (world == worlds_.end()) refuse_gltf("a joint that is no node of the scene");
      std::array<double, 16> bind{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
      if (!inverse.empty()) std::copy_n(inverse.begin() + static_cast<std::ptrdiff_t>(16 * j), 16, bind.begin());
      matrices.push_back(as_matrix(bind) * world->second);
    }
    return matrices;
  }

  GltfFile& gltf_;
  std::map<std::uint64_t, M44d> worlds_;
  std::vector<std::uint64_t> order_;
};

}  // namespace

std::vector<MeshInstance> mesh_instances(GltfFile& gltf) { return Scene(gltf).instances(); }

}  // namespace vitrine::io
