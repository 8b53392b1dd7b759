// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Baked models to deliver, and what a client makes of the bytes.

#include "io/mesh_codec.h"

#include <array>
#include <span>
#include <vector>

namespace vitrine::test {

/// A bumpy sphere on a grid of 11 bits, cut into charts along seeded planes: uvs on their grid and
/// tangents, both differing between charts.
BakedModel random_model(unsigned seed, int slices = 24, int stacks = 12);

/// The same sphere with nothing but colours per vertex, on their grid of 5 bits.
BakedModel coloured_model(unsigned seed);

/// Decodes with the Draco library alone.
io::VertexMesh decode_draco(std::span<std::byte const> bytes);

/// Position, uv, tangent and colour of a triangle's corners, the least corner first, the winding kept.
using Corners = std::array<std::array<float, 12>, 3>;
/// Of all triangles, sorted: equal for meshes that differ in nothing but order.
std::vector<Corners> corners(io::VertexMesh const& mesh);

}  // namespace vitrine::test
