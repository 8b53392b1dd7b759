// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What every reader promises of any bytes: a valid model, or an Error that is not ours.

#include "io/read_model.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace vitrine::fuzz {

/// Stops the program, which is how a fuzzer learns of it.
inline void require(bool promise) {
  if (!promise) std::abort();
}

inline bool one_each(std::size_t attributes, std::size_t of) { return attributes == 0 || attributes == of; }

/// Indices and sizes fit, colours and texture coordinates are finite; positions and normals need not be.
inline void require_valid(SourceModel const& model) {
  std::size_t const vertices = model.mesh.positions.size();
  require(!model.mesh.triangles.empty());
  for (Triangle const& triangle : model.mesh.triangles)
    for (std::uint32_t index : triangle) require(index < vertices);
  require(one_each(model.normals.size(), vertices));
  require(one_each(model.uvs.size(), vertices));
  require(one_each(model.colours.size(), vertices));
  require(one_each(model.face_materials.size(), model.mesh.triangles.size()));
  for (V2f const& uv : model.uvs) require(std::isfinite(uv.x) && std::isfinite(uv.y));
  require(!model.materials.empty());
  for (std::uint16_t material : model.face_materials) require(material < model.materials.size());
  for (Material const& material : model.materials)
    require(std::max(material.colour_map.image, material.normal_map.image) < int(model.images.size()));
}

using Reader = SourceModel (*)(io::Blob const&, io::Resolve const&, io::ReadOptions const&);

/// Reads the bytes as a model whose names all lead back to the same bytes: a material library and textures of their
/// own.
inline int read(Reader reader, std::uint8_t const* data, std::size_t size) {
  io::Blob const file{{reinterpret_cast<std::byte const*>(data), size}, nullptr};
  io::ReadOptions options;
  options.limits.texels = 1 << 20;
  options.limits.bytes = 64 << 20;
  try {
    require_valid(reader(
        file, [&](std::string_view) { return std::optional<io::Blob>(file); }, options));
  } catch (Error const& error) {
    require(error.kind() != ErrorKind::broken);
    require(!error.remedy().empty());
  }
  return 0;
}

}  // namespace vitrine::fuzz
