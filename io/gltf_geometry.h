// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A mesh as geometry of a glTF document, in the forms that the profiles deliver.

#include "io/gltf_document.h"
#include "io/mesh_codec.h"

#include <cstdint>

namespace vitrine::io {

/// What the document's mesh and node must say about geometry that has been written.
struct WrittenGeometry {
  Json primitive;  ///< attributes, indices, extensions
  V3f translation{0, 0, 0};
  float scale = 1;        ///< stored position * scale + translation = position
  std::size_t bytes = 0;  ///< of coded geometry
  std::uint32_t vertices = 0, triangles = 0;
};

/// KHR_draco_mesh_compression. The positions' bounds are rounded outwards by less than 0.1 % of the grid: fewer digits.
WrittenGeometry write_draco(GltfDocument& document, VertexMesh const& mesh, Grid const& grid);

/// KHR_mesh_quantization: interleaved vertices with 16-bit positions (the grid's own integers) and uvs, 8-bit normals
/// (16-bit where the grid has more than 8 bits), tangents and colours; in cache order, which servers' gzip likes too.
WrittenGeometry write_buffers(GltfDocument& document, VertexMesh const& mesh, Grid const& grid);

/// Without any extension: positions, normals, tangents and uvs as floats, colours as bytes.
WrittenGeometry write_floats(GltfDocument& document, VertexMesh const& mesh);

/// The same vertices and indices as write_buffers by EXT_meshopt_compression, without a fallback for clients that lack
/// it.
WrittenGeometry write_meshopt(GltfDocument& document, VertexMesh const& mesh, Grid const& grid);

}  // namespace vitrine::io
