// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Ambient occlusion.

#include "stages/ray_scene.h"

namespace vitrine {

/// Share of the light of an evenly bright sky, weighted by the cosine to the unit `normal`, that reaches a point.
/// `offset`: how far above the surface rays start, in model units. Each `pattern` is another rotation of the same set
/// of directions (Hammersley points), so that neighbours with different patterns average to less noise.
float visibility(RayScene const& scene, V3f const& point, V3f const& normal, float offset, int rays,
                 std::uint32_t pattern);

}  // namespace vitrine
