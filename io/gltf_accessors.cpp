// SPDX-License-Identifier: Apache-2.0
#include "io/gltf_accessors.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

namespace vitrine::io {
namespace {

std::size_t components_of(std::string const& type) {
  static std::pair<std::string_view, std::size_t> const known[] = {
      {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
  for (auto const& [name, components] : known)
    if (type == name) return components;
  refuse_gltf("accessor of type \"" + type.substr(0, 20) + "\"");
}

/// The elements of one accessor in a view; throws when the last one ends past it.
ComponentArray in_view(BufferView const& view, std::uint64_t offset, ComponentArray array) {
  std::size_t const element = array.components * size_of(array.type);
  array.stride = view.stride == 0 ? element : view.stride;
  std::size_t const size = view.bytes.size();
  bool const fits = array.count == 0 || (offset <= size && element <= size - offset &&
                                         (array.count - 1) <= (size - offset - element) / array.stride);
  if (!fits)
    refuse_gltf("an accessor of " + std::to_string(array.count) + " elements, " + std::to_string(array.stride) +
                " bytes apart from byte " + std::to_string(offset) + ", in a view of " + std::to_string(size) +
                " bytes");
  if (array.count > 0) array.bytes = view.bytes.subspan(offset);
  return array;
}

/// Own and tight bytes, zero where there was no view.
void take_over(ComponentArray& array) {
  std::size_t const element = array.components * size_of(array.type);
  std::vector<std::byte> storage(array.count * element);
  if (!array.bytes.empty())
    for (std::uint64_t i = 0; i < array.count; ++i)
      std::memcpy(storage.data() + i * element, array.bytes.data() + i * array.stride, element);
  array.storage = std::move(storage);
  array.bytes = array.storage;
  array.stride = element;
}

/// Replaces some elements. Source: glTF 2.0 specification, section 3.6.2.3.
void apply_sparse(GltfFile& gltf, GltfJson const& sparse, ComponentArray& array) {
  GltfJson const* const where = member(sparse, "indices");
  GltfJson const* const what = member(sparse, "values");
  if (!where || !what) refuse_gltf("a sparse accessor without indices or values");
  ComponentArray places, values;
  places.count = values.count = required(sparse, "count");
  places.type = static_cast<Component>(required(*where, "componentType"));
  values.components = array.components;
  values.type = array.type;
  places =
      in_view(gltf.view(required(*where, "bufferView")), whole(*where, "byteOffset").value_or(0), std::move(places));
  values = in_view(gltf.view(required(*what, "bufferView")), whole(*what, "byteOffset").value_or(0), std::move(values));
  take_over(array);
  std::vector<std::uint32_t> const targets = to_indices(places);
  for (std::uint64_t i = 0; i < targets.size(); ++i) {
    if (targets[i] >= array.count)
      refuse_gltf("a sparse accessor replaces element " + std::to_string(targets[i]) + " of " +
                  std::to_string(array.count));
    std::memcpy(array.storage.data() + targets[i] * array.stride, values.bytes.data() + i * values.stride,
                array.stride);
  }
}

/// convert(value) for each component, in order; T as stored, little endian.
template <class T, class Out, class Convert>
void convert_all(ComponentArray const& array, std::vector<Out>& out, Convert const& convert) {
  out.reserve(array.count * array.components);
  for (std::uint64_t i = 0; i < array.count; ++i)
    for (std::size_t k = 0; k < array.components; ++k) {
      T value;
      std::memcpy(&value, array.bytes.data() + i * array.stride + k * sizeof(T), sizeof(T));
      out.push_back(convert(value));
    }
}

template <class T>
std::vector<float> floats_of(ComponentArray const& array) {
  std::vector<float> result;
  convert_all<T>(array, result, [&](T value) {
    if (std::is_floating_point_v<T> || !array.normalized) return static_cast<float>(value);
    return std::max(static_cast<float>(value) / static_cast<float>(std::numeric_limits<T>::max()), -1.0f);
  });
  return result;
}

template <class T>
std::vector<std::uint32_t> whole_numbers_of(ComponentArray const& array) {
  std::vector<std::uint32_t> result;
  convert_all<T>(array, result, [](T value) { return static_cast<std::uint32_t>(value); });
  return result;
}

}  // namespace

std::size_t size_of(Component component) {
  switch (component) {
    case Component::int8:
    case Component::uint8:
      return 1;
    case Component::int16:
    case Component::uint16:
      return 2;
    case Component::uint32:
    case Component::float32:
      return 4;
  }
  refuse_gltf("componentType " + std::to_string(static_cast<int>(component)));
}

std::vector<float> to_floats(ComponentArray const& array) {
  switch (array.type) {
    case Component::int8:
      return floats_of<std::int8_t>(array);
    case Component::uint8:
      return floats_of<std::uint8_t>(array);
    case Component::int16:
      return floats_of<std::int16_t>(array);
    case Component::uint16:
      return floats_of<std::uint16_t>(array);
    case Component::uint32:
      return floats_of<std::uint32_t>(array);
    case Component::float32:
      return floats_of<float>(array);
  }
  return {};
}

std::vector<std::uint32_t> to_indices(ComponentArray const& array) {
  if (array.components == 1 || array.components == 4) {
    if (array.type == Component::uint8) return whole_numbers_of<std::uint8_t>(array);
    if (array.type == Component::uint16) return whole_numbers_of<std::uint16_t>(array);
    if (array.type == Component::uint32) return whole_numbers_of<std::uint32_t>(array);
  }
  refuse_gltf("indices of componentType " + std::to_string(static_cast<int>(array.type)));
}

ComponentArray read_accessor(GltfFile& gltf, std::uint64_t index) {
  GltfJson const& accessor = gltf.item("accessors", index);
  GltfJson const* const sparse = member(accessor, "sparse");
  std::optional<std::uint64_t> const view = whole(accessor, "bufferView");
  ComponentArray array;
  array.count = required(accessor, "count");
  array.components = components_of(string(accessor, "type"));
  array.type = static_cast<Component>(required(accessor, "componentType"));
  array.normalized = flag(accessor, "normalized");
  if (view)
    array = in_view(gltf.view(*view), whole(accessor, "byteOffset").value_or(0), std::move(array));
  else if (array.count > gltf.bytes_present())
    refuse_gltf("accessors[" + std::to_string(index) + "] of " + std::to_string(array.count) +
                " elements has no bytes");
  else
    take_over(array);
  if (sparse) apply_sparse(gltf, *sparse, array);
  return array;
}

}  // namespace vitrine::io
