// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Geometry as bytes: Draco (edgebreaker), and back.

#include "stages/data.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace vitrine::io {

using Imath::V4f;

/// A mesh as clients draw it: every attribute per vertex, vertices split where corners differ.
struct VertexMesh {
  std::vector<V3f> positions;
  std::vector<V3f> normals;   ///< as many, or empty
  std::vector<V4f> tangents;  ///< as many, as glTF's TANGENT: an axis and w = 1; or empty
  std::vector<V2f> uvs;       ///< as many, or empty
  std::vector<V3f> colours;   ///< as many, linear, in [0,1], or empty
  std::vector<Triangle> triangles;
  bool palette = false;  ///< uvs name colours: they vary as colours do, not as places
};

/// Splits the welded vertices of a baked model where texture coordinates or tangents differ between corners; vertices
/// in the order in which the triangles first use them, those that none uses dropped.
VertexMesh split_vertices(BakedModel const& model);

struct DracoMesh {
  std::vector<std::byte> bytes;
  int position_id = -1, normal_id = -1, tangent_id = -1, uv_id = -1,
      colour_id = -1;                         ///< unique ids for KHR_draco_mesh_compression
  std::uint32_t vertices = 0, triangles = 0;  ///< as decoded
};

/// Encodes on the grid's own steps: what was quantised before is stored without further loss, and so are tangents along
/// axes (others are not). Speed 0. Equal vertices become one, triangles that use a vertex twice are dropped. What
/// edgebreaker cannot take is stored with sequential connectivity.
/// Colours are floats on even steps of linear light. Normalised bytes on steps even in sRGB would spread the error
/// better, but Draco cannot pack their uneven residuals: 5 to 40 % more bytes at the same error on three scans.
/// Errors: Broken for a mesh without triangles, a grid without extent, or when Draco refuses both ways.
DracoMesh encode_draco(VertexMesh const& mesh, Grid const& grid);

}  // namespace vitrine::io
