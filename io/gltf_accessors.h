// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Numbers in glTF buffers. Internal to io.

#include "io/gltf_file.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace vitrine::io {

/// As glTF numbers them.
enum class Component { int8 = 5120, uint8 = 5121, int16 = 5122, uint16 = 5123, uint32 = 5125, float32 = 5126 };

/// Bytes of one component. Errors: InvalidInput for a number that glTF does not define.
std::size_t size_of(Component component);

/// Elements of 1 to 16 components somewhere in memory; every byte that they touch is inside `bytes`.
struct ComponentArray {
  ComponentArray() = default;
  ComponentArray(ComponentArray&&) = default;
  ComponentArray& operator=(ComponentArray&&) = default;

  std::span<std::byte const> bytes;
  std::size_t stride = 0;
  std::uint64_t count = 0;
  std::size_t components = 1;
  Component type = Component::float32;
  bool normalized = false;
  std::vector<std::byte> storage;  ///< what `bytes` shows, where the array owns it
};

/// count x components numbers; normalised integers become 0..1 or -1..1, others their value.
std::vector<float> to_floats(ComponentArray const& array);

/// Errors: InvalidInput when the array does not hold single unsigned integers.
std::vector<std::uint32_t> to_indices(ComponentArray const& array);

/// An accessor with its sparse replacements; zeros where it has no view. Errors: InvalidInput when it reaches past its
/// view, names what is not there, or has more elements without a view than the file has bytes.
ComponentArray read_accessor(GltfFile& gltf, std::uint64_t index);

}  // namespace vitrine::io
