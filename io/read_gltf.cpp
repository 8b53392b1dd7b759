// SPDX-License-Identifier: Apache-2.0
#include "io/assemble.h"
#include "io/gltf_file.h"
#include "io/gltf_materials.h"
#include "io/gltf_primitive.h"
#include "io/gltf_scene.h"
#include "io/read_model.h"

#include <algorithm>
#include <iterator>

namespace vitrine::io {
namespace {

/// A direction under a matrix that may scale unevenly or mirror: by the inverse's transpose; zero where there is none.
V3f turned(V3f const& normal, M44d const& inverse_transposed) {
  V3d direction;
  inverse_transposed.multDirMatrix(V3d(normal), direction);
  return unit_or_zero(direction);
}

/// A TANGENT moves with the surface; its side stays as it is stored. Zero where it has no direction.
V4f moved(std::array<float, 4> const& tangent, M44d const& world) {
  V3d direction;
  world.multDirMatrix(V3d(tangent[0], tangent[1], tangent[2]), direction);
  V3f const unit = unit_or_zero(direction);
  return {unit.x, unit.y, unit.z, tangent[3] < 0 ? -1.f : 1.f};
}

M44d for_normals(M44d const& world) {
  return world.determinant() == 0 ? M44d(world).transposed() : world.inverse().transposed();
}

/// The weighted mean of the vertex's joints; weights are brought to a sum of 1.
M44d skin_matrix(GltfPrimitive const& part, std::vector<M44d> const& joints, std::size_t vertex) {
  M44d sum;
  sum *= 0;
  double total = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    double const weight = part.weights[vertex][k];
    if (!(weight > 0)) continue;
    std::uint32_t const joint = part.joints[vertex][k];
    if (joint >= joints.size())
      refuse_gltf("a vertex names joint " + std::to_string(joint) + " of " + std::to_string(joints.size()));
    sum += joints[joint] * weight;
    total += weight;
  }
  return total > 0 ? sum * (1 / total) : joints.front();
}

/// Positions and normals of the rest pose, before the node's transform.
struct Pose {
  std::vector<V3d> positions;
  std::vector<V3f> normals;
};

Pose rest_pose(GltfPrimitive const& part, MeshInstance const& instance) {
  Pose pose{{part.positions.begin(), part.positions.end()}, part.normals};
  for (std::size_t t = 0; t < std::min(part.targets.size(), instance.morph_weights.size()); ++t) {
    MorphTarget const& target = part.targets[t];
    double const weight = instance.morph_weights[t];
    if (weight == 0) continue;
    for (std::size_t i = 0; i < target.positions.size(); ++i) pose.positions[i] += V3d(target.positions[i]) * weight;
    for (std::size_t i = 0; i < std::min(target.normals.size(), pose.normals.size()); ++i)
      pose.normals[i] += target.normals[i] * static_cast<float>(weight);
  }
  return pose;
}

/// Collects the parts of a scene in one model.
class Flattener {
 public:
  Flattener(GltfFile& gltf, SourceModel& model, ReadOptions const& options)
      : gltf_(gltf), model_(model), materials_(gltf, model, options) {}

  /// `instances` share one mesh.
  void add(std::span<MeshInstance const> instances) {
    for (GltfJson const& description : list(gltf_.item("meshes", instances.front().mesh), "primitives")) {
      if (!has_triangles(description)) {
        ++left_out_;
        continue;
      }
      GltfMaterials::Entry const material = materials_.take(whole(description, "material"));
      GltfPrimitive part = read_primitive(gltf_, description, material.uv_set);
      if (material.only_emits) part.colours.clear();
      for (MeshInstance const& instance : instances) add_part(part, instance, material.index);
    }
  }

  void finish() {
    if (model_.mesh.triangles.empty()) throw no_faces("glTF", positions_.size());
    if (left_out_ > 0) model_.notes.push_back(std::to_string(left_out_) + " primitives of points or lines left out");
    pad(positions_.size());
    place(model_, positions_);
    if (model_.materials.size() == 1) model_.face_materials.clear();
    if (model_.uvs.empty()) drop_maps();
  }

 private:
  void add_part(GltfPrimitive const& part, MeshInstance const& instance, std::uint16_t material) {
    std::size_t const first = positions_.size(), vertices = first + part.positions.size();
    std::size_t const faces = model_.mesh.triangles.size() + part.triangles.size();
    check_limits(gltf_.limits(), vertices, faces, vertices * kBytesPerVertex + faces * (sizeof(Triangle) + 2));
    Pose const pose = rest_pose(part, instance);
    bool const skinned = !instance.joints.empty() && !part.joints.empty() && !part.weights.empty();
    bool const mirrored = !skinned && instance.world.determinant() < 0;
    add_places(part, pose, instance, skinned);
    append(model_.uvs, part.uvs, first, V2f(0, 0));
    append(model_.colours, part.colours, first, kWhite);
    for (Triangle t : part.triangles) {
      if (mirrored) std::swap(t[1], t[2]);
      for (std::uint32_t& corner : t) corner += static_cast<std::uint32_t>(first);
      model_.mesh.triangles.push_back(t);
    }
    model_.face_materials.resize(faces, material);
  }

  void add_places(GltfPrimitive const& part, Pose const& pose, MeshInstance const& instance, bool skinned) {
    M44d world = instance.world, to_normals = for_normals(world);
    std::vector<V3f> normals;
    std::vector<V4f> tangents;
    normals.reserve(pose.normals.size());
    tangents.reserve(part.tangents.size());
    std::size_t const first = positions_.size();
    for (std::size_t i = 0; i < pose.positions.size(); ++i) {
      if (skinned) {
        world = skin_matrix(part, instance.joints, i);
        if (!pose.normals.empty()) to_normals = for_normals(world);
      }
      positions_.push_back(pose.positions[i] * world);
      if (!pose.normals.empty()) normals.push_back(turned(pose.normals[i], to_normals));
      if (!part.tangents.empty()) tangents.push_back(moved(part.tangents[i], world));
    }
    append(model_.normals, normals, first, V3f(0, 0, 0));
    append(model_.tangents, tangents, first, V4f(0, 0, 0, 0));
  }

  /// Adds a part's attribute; vertices before it that have none get `missing`. `clean` replaces normals of zero length.
  template <class T>
  static void append(std::vector<T>& all, std::vector<T> const& part, std::size_t first, T const& missing) {
    if (part.empty()) return;
    all.resize(first, missing);
    all.insert(all.end(), part.begin(), part.end());
  }

  void pad(std::size_t vertices) {
    if (!model_.normals.empty()) model_.normals.resize(vertices, V3f(0, 0, 0));
    if (!model_.tangents.empty()) model_.tangents.resize(vertices, V4f(0, 0, 0, 0));
    if (!model_.uvs.empty()) model_.uvs.resize(vertices, V2f(0, 0));
    if (!model_.colours.empty()) model_.colours.resize(vertices, kWhite);
  }

  void drop_maps() {
    for (Material& material : model_.materials) {
      if (material.colour_map.image >= 0 || material.normal_map.image >= 0 || material.occlusion_map.image >= 0 ||
          material.emission_map.image >= 0)
        model_.notes.push_back("textures of material \"" + material.name +
                               "\" left out: there are no texture coordinates");
      material.colour_map = material.normal_map = material.occlusion_map = material.emission_map = TextureUse{};
    }
    model_.images.clear();
  }

  GltfFile& gltf_;
  SourceModel& model_;
  GltfMaterials materials_;
  std::vector<V3d> positions_;
  std::uint64_t left_out_ = 0;
};

}  // namespace

SourceModel read_gltf(Blob const& file, Resolve const& resolve, ReadOptions const& options) {
  GltfFile gltf(file, resolve, options.limits);
  std::vector<MeshInstance> instances = mesh_instances(gltf);
  std::stable_sort(instances.begin(), instances.end(),
                   [](MeshInstance const& a, MeshInstance const& b) { return a.mesh < b.mesh; });
  SourceModel model;
  Flattener flattener(gltf, model, options);
  for (auto begin = instances.cbegin(); begin != instances.cend();) {
    auto const end =
        std::find_if(begin, instances.cend(), [&](MeshInstance const& i) { return i.mesh != begin->mesh; });
    flattener.add({begin, end});
    begin = end;
  }
  flattener.finish();
  return model;
}

}  // namespace vitrine::io
