// SPDX-License-Identifier: Apache-2.0
#pragma once
/// One glTF primitive as triangles over vertices of its own. Internal to io.

#include "io/gltf_file.h"
#include "stages/data.h"

#include <array>
#include <cstdint>
#include <vector>

namespace vitrine::io {

struct MorphTarget {
  std::vector<V3f> positions, normals;  ///< differences; as many as vertices, or empty
};

/// Attributes are as many as positions, or empty.
struct GltfPrimitive {
  std::vector<V3f> positions;
  std::vector<V3f> normals;
  std::vector<std::array<float, 4>> tangents;
  std::vector<V2f> uvs;  ///< finite
  std::vector<Rgba16> colours;
  std::vector<std::array<std::uint32_t, 4>> joints;
  std::vector<std::array<float, 4>> weights;
  std::vector<MorphTarget> targets;
  std::vector<Triangle> triangles;  ///< each index below positions.size()
};

/// Whether it is made of triangles (single, strip, fan), not of points or lines.
bool has_triangles(GltfJson const& primitive);

/// Errors: InvalidInput for attributes of the wrong type or of different counts, and for an index past the vertices.
GltfPrimitive read_primitive(GltfFile& gltf, GltfJson const& primitive, std::uint64_t uv_set);

}  // namespace vitrine::io
