// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A thumbnail without its decoder, for pages of so few objects that the decoder weighs more than it saves.

#include <cstddef>
#include <span>
#include <vector>

namespace vitrine::io {

/// In:     a GLB as encode() writes it for Profile::web.
/// Out:    the same object with quantised buffers (gltf_geometry.h) in place of Draco: positions within 1/131070 of its
///         box's longest edge, normals within half a step of 1/127; node, material and coded maps unchanged. Empty
///         where the geometry is not Draco's.
/// Errors: InvalidInput for a damaged file, or one of another tool that holds more than one primitive.
std::vector<std::byte> plain_glb(std::span<std::byte const> thumbnail);

}  // namespace vitrine::io
