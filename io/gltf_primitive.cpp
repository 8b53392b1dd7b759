// SPDX-License-Identifier: Apache-2.0
#include "io/gltf_primitive.h"

#include "io/assemble.h"
#include "io/colour.h"
#include "io/gltf_accessors.h"
#include "io/gltf_compression.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace vitrine::io {
namespace {

enum Mode : std::uint64_t { triangles = 4, strip = 5, fan = 6 };

std::uint64_t mode_of(GltfJson const& primitive) { return whole(primitive, "mode").value_or(Mode::triangles); }

/// The attributes of a primitive, in buffers or in a Draco stream.
class Attributes {
 public:
  Attributes(GltfFile& gltf, GltfJson const& primitive) : gltf_(gltf), accessors_(member(primitive, "attributes")) {
    if (!accessors_) refuse_gltf("a primitive without attributes");
    if (GltfJson const* const draco = extension(primitive, "KHR_draco_mesh_compression")) open_draco(*draco);
  }

  bool compressed() const { return draco_ids_ != nullptr; }
  std::vector<std::uint32_t> draco_indices() { return std::move(draco_.indices); }

  /// The attribute with this many components; one without elements when the primitive has none of that name.
  ComponentArray take(std::string const& name, std::size_t low, std::size_t high) {
    std::optional<std::uint64_t> const accessor = whole(*accessors_, name.c_str());
    ComponentArray array;
    if (!accessor) return array;
    std::optional<std::uint64_t> const id = draco_ids_ ? whole(*draco_ids_, name.c_str()) : std::nullopt;
    if (id) {
      auto found = draco_.attributes.extract(*id);
      if (found.empty()) refuse_gltf("two attributes share Draco attribute " + std::to_string(*id));
      array = std::move(found.mapped());
      array.normalized = flag(gltf_.item("accessors", *accessor), "normalized");
    } else {
      array = read_accessor(gltf_, *accessor);
    }
    if (array.components < low || array.components > high)
      refuse_gltf("attribute " + name + " has " + std::to_string(array.components) + " components");
    return array;
  }

 private:
  void open_draco(GltfJson const& draco) {
    draco_ids_ = member(draco, "attributes");
    if (!draco_ids_ || !draco_ids_->is_object()) refuse_gltf("a Draco primitive without attributes");
    std::vector<std::uint64_t> ids;
    for (auto const& [name, id] : draco_ids_->items()) ids.push_back(required(*draco_ids_, name.c_str()));
    draco_ = decode_draco(gltf_.view(required(draco, "bufferView")).bytes, ids, gltf_.limits());
  }

  GltfFile& gltf_;
  GltfJson const* accessors_;
  GltfJson const* draco_ids_ = nullptr;
  DracoGeometry draco_;
};

/// Integer positions and normals need the extension that allows them.
void check_type(GltfFile const& gltf, ComponentArray const& array, std::string const& name) {
  bool const plain = array.count == 0 || array.type == Component::float32;
  if (!plain && (array.type == Component::uint32 || !gltf.uses("KHR_mesh_quantization")))
    refuse_gltf("attribute " + name + " has componentType " + std::to_string(static_cast<int>(array.type)));
}

std::vector<V3f> vectors(GltfFile const& gltf, ComponentArray const& array, std::string const& name) {
  check_type(gltf, array, name);
  std::vector<float> const values = to_floats(array);
  std::vector<V3f> result(array.count);
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
  return result;
}

std::vector<V2f> texture_coordinates(ComponentArray const& array) {
  std::vector<float> values = to_floats(array);
  for (float& value : values)
    if (!std::isfinite(value)) value = 0;
  std::vector<V2f> result(array.count);
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = {values[2 * i], values[2 * i + 1]};
  return result;
}

/// COLOR_0 is linear and, as integers, always normalised.
std::vector<Rgba16> colours(ComponentArray array) {
  array.normalized = true;
  std::vector<float> const values = to_floats(array);
  std::vector<Rgba16> result(array.count, kWhite);
  for (std::size_t i = 0; i < result.size(); ++i)
    for (std::size_t k = 0; k < array.components; ++k) {
      float const value = values[array.components * i + k];
      result[i][k] = value > 0 ? unit16(value) : std::uint16_t{0};  // nan too is 0
    }
  return result;
}

template <class T, class Values>
std::vector<std::array<T, 4>> fours(Values const& values) {
  std::vector<std::array<T, 4>> result(values.size() / 4);
  for (std::size_t i = 0; i < result.size(); ++i)
    std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(4 * i), 4, result[i].begin());
  return result;
}

std::vector<MorphTarget> morph_targets(GltfFile& gltf, GltfJson const& primitive) {
  std::vector<MorphTarget> result;
  for (GltfJson const& target : list(primitive, "targets")) {
    auto const differences = [&](char const* name) {
      std::optional<std::uint64_t> const accessor = whole(target, name);
      if (!accessor) return std::vector<V3f>();
      ComponentArray const array = read_accessor(gltf, *accessor);
      if (array.components != 3)
        refuse_gltf(std::string("a morph target's ") + name + " has " + std::to_string(array.components) +
                    " components");
      return vectors(gltf, array, name);
    };
    result.push_back({differences("POSITION"), differences("NORMAL")});
  }
  return result;
}

template <class T>
void check_count(GltfPrimitive const& primitive, std::vector<T> const& attribute, char const* name) {
  if (!attribute.empty() && attribute.size() != primitive.positions.size())
    refuse_gltf(std::to_string(attribute.size()) + " elements of " + name + " for " +
                std::to_string(primitive.positions.size()) + " vertices");
}

void check_counts(GltfPrimitive const& p) {
  check_count(p, p.normals, "NORMAL");
  check_count(p, p.tangents, "TANGENT");
  check_count(p, p.uvs, "TEXCOORD");
  check_count(p, p.colours, "COLOR_0");
  check_count(p, p.joints, "JOINTS_0");
  check_count(p, p.weights, "WEIGHTS_0");
  for (MorphTarget const& target : p.targets) {
    check_count(p, target.positions, "a morph target");
    check_count(p, target.normals, "a morph target");
  }
}

std::vector<Triangle> triangles_of(std::vector<std::uint32_t> const& corners, std::uint64_t mode) {
  std::vector<Triangle> result;
  if (mode == Mode::triangles) {
    for (std::size_t i = 2; i < corners.size(); i += 3) result.push_back({corners[i - 2], corners[i - 1], corners[i]});
  } else {
    for (std::size_t i = 2; i < corners.size(); ++i) {
      if (mode == Mode::fan)
        result.push_back({corners[0], corners[i - 1], corners[i]});
      else if (i % 2 == 0)
        result.push_back({corners[i - 2], corners[i - 1], corners[i]});
      else
        result.push_back({corners[i - 1], corners[i - 2], corners[i]});
    }
  }
  return result;
}

std::vector<std::uint32_t> corners_of(GltfFile& gltf, GltfJson const& primitive, Attributes& attributes,
                                      std::size_t vertices) {
  std::vector<std::uint32_t> corners;
  if (attributes.compressed()) {
    corners = attributes.draco_indices();
  } else if (std::optional<std::uint64_t> const accessor = whole(primitive, "indices")) {
    ComponentArray const array = read_accessor(gltf, *accessor);
    if (array.components != 1) refuse_gltf("indices with " + std::to_string(array.components) + " components");
    corners = to_indices(array);
  } else {
    corners.resize(vertices);
    std::iota(corners.begin(), corners.end(), 0u);
  }
  for (std::uint32_t const corner : corners)
    if (corner >= vertices)
      refuse_gltf("an index names vertex " + std::to_string(corner) + " of " + std::to_string(vertices));
  return corners;
}

template <class T>
void gather(std::vector<T>& values, std::vector<std::uint32_t> const& from) {
  if (values.empty()) return;
  std::vector<T> gathered;
  gathered.reserve(from.size());
  for (std::uint32_t const i : from) gathered.push_back(values[i]);
  values = std::move(gathered);
}

/// Primitives of one mesh often share the vertices of all; each would bring them all along.
void drop_unused(GltfPrimitive& p) {
  constexpr std::uint32_t unused = ~std::uint32_t{0};
  std::vector<std::uint32_t> number(p.positions.size(), unused), kept;
  for (Triangle const& t : p.triangles)
    for (std::uint32_t const corner : t) number[corner] = 0;
  for (std::uint32_t i = 0; i < number.size(); ++i) {
    if (number[i] == unused) continue;
    number[i] = static_cast<std::uint32_t>(kept.size());
    kept.push_back(i);
  }
  if (kept.size() == number.size()) return;
  for (Triangle& t : p.triangles)
    for (std::uint32_t& corner : t) corner = number[corner];
  gather(p.positions, kept);
  gather(p.normals, kept);
  gather(p.tangents, kept);
  gather(p.uvs, kept);
  gather(p.colours, kept);
  gather(p.joints, kept);
  gather(p.weights, kept);
  for (MorphTarget& target : p.targets) {
    gather(target.positions, kept);
    gather(target.normals, kept);
  }
}

}  // namespace

bool has_triangles(GltfJson const& primitive) {
  std::uint64_t const mode = mode_of(primitive);
  return mode == Mode::triangles || mode == Mode::strip || mode == Mode::fan;
}

GltfPrimitive read_primitive(GltfFile& gltf, GltfJson const& description, std::uint64_t uv_set) {
  Attributes attributes(gltf, description);
  GltfPrimitive primitive;
  primitive.positions = vectors(gltf, attributes.take("POSITION", 3, 3), "POSITION");
  check_limits(gltf.limits(), primitive.positions.size(), 0, 0);
  primitive.normals = vectors(gltf, attributes.take("NORMAL", 3, 3), "NORMAL");
  primitive.tangents = fours<float>(to_floats(attributes.take("TANGENT", 4, 4)));
  primitive.uvs = texture_coordinates(attributes.take("TEXCOORD_" + std::to_string(uv_set), 2, 2));
  primitive.colours = colours(attributes.take("COLOR_0", 3, 4));
  ComponentArray const joints = attributes.take("JOINTS_0", 4, 4);
  if (joints.count > 0) primitive.joints = fours<std::uint32_t>(to_indices(joints));
  primitive.weights = fours<float>(to_floats(attributes.take("WEIGHTS_0", 4, 4)));
  primitive.targets = morph_targets(gltf, description);
  check_counts(primitive);
  // A Draco stream holds single triangles, even where the mode says strip.
  std::uint64_t const mode = attributes.compressed() ? std::uint64_t{Mode::triangles} : mode_of(description);
  primitive.triangles = triangles_of(corners_of(gltf, description, attributes, primitive.positions.size()), mode);
  drop_unused(primitive);
  return primitive;
}

}  // namespace vitrine::io
