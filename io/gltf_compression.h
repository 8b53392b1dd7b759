// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Compressed geometry in glTF: EXT_meshopt_compression and KHR_draco_mesh_compression. Internal to io.

#include "io/gltf_accessors.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace vitrine::io {

/// A buffer view as the meshopt extension describes it.
struct MeshoptStream {
  std::span<std::byte const> bytes;
  std::uint64_t count = 0;
  std::uint64_t stride = 0;
  std::string mode;    ///< ATTRIBUTES, TRIANGLES or INDICES
  std::string filter;  ///< empty, NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL
};

/// count x stride bytes. Errors: InvalidInput for a damaged stream or one too short for its count; LimitExceeded.
std::vector<std::byte> decode_meshopt(MeshoptStream const& stream, std::uint64_t byte_limit);

struct DracoGeometry {
  std::uint64_t vertices = 0;
  std::vector<std::uint32_t> indices;                  ///< triangles' corners, each below `vertices`
  std::map<std::uint64_t, ComponentArray> attributes;  ///< by unique id, those that were asked for
};

/// Errors: InvalidInput for a damaged stream, or one whose header claims more than its bytes can hold; LimitExceeded;
/// Unsupported for point clouds and bitstreams before 2.2.
DracoGeometry decode_draco(std::span<std::byte const> bytes, std::span<std::uint64_t const> attribute_ids,
                           ReadLimits const& limits);

}  // namespace vitrine::io
