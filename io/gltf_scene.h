// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Where the meshes of a glTF scene stand. Internal to io.

#include "io/gltf_file.h"

#include <Imath/ImathMatrix.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace vitrine::io {

using Imath::M44d;

/// A mesh drawn once. Imath multiplies rows: world position = position * world.
struct MeshInstance {
  std::uint64_t mesh = 0;
  M44d world;
  std::vector<M44d> joints;           ///< of a skin: inverse bind matrix * joint's world, which then replaces `world`
  std::vector<double> morph_weights;  ///< of the node, else of the mesh, else empty: zero
};

/// The default scene, or the first; in the order of the tree, parents first.
/// Errors: InvalidInput when there is no scene, or a node is reached twice (a cycle); LimitExceeded below `nesting`.
std::vector<MeshInstance> mesh_instances(GltfFile& gltf);

}  // namespace vitrine::io
