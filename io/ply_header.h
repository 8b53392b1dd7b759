// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the header of a PLY file says follows it. Internal to io.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vitrine::io {

enum class PlyFormat { ascii, little_endian, big_endian };
enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t size_of(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;    ///< of the value, or of a list's values
  std::optional<PlyType> count_type;  ///< lists only
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  /// The first of these names that is a property (a list, or none); nothing when none is.
  std::optional<std::size_t> scalar(std::initializer_list<std::string_view> names) const;
  std::optional<std::size_t> list(std::initializer_list<std::string_view> names) const;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;
  std::vector<std::string> textures;  ///< comment TextureFile NAME
  std::size_t bytes = 0;              ///< where the body begins
  std::uint64_t lines = 0;
};

/// Errors: InvalidInput for what is no PLY header, with the line.
PlyHeader parse_ply_header(std::string_view file);

}  // namespace vitrine::io
