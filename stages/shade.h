// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How a surface looks under the light of the measure: what three.js r187 shows for a white ambient light and a white
/// directional light on its standard material with roughness 1 and metalness 0.

#include "stages/data.h"

namespace vitrine {

/// Linear radiance of a point. All vectors are unit; `normal` on the side of the eye (two-sided surfaces are turned).
/// Ambient 0.25 and directional 0.7 of the base colour, less what the specular lobe (GGX, F0 0.04) takes from the
/// diffuse one. Source: the shader chunks lights_physical and bsdfs of three.js; the terms that it tabulates are
/// polynomials here, within 0.0034 of its table.
V3f shade(V3f const& base_colour, V3f const& normal, V3f const& to_eye, V3f const& to_light);

/// The byte that a client writes for a linear value: sRGB encoded, clamped, rounded.
std::uint8_t srgb_byte(float linear);

}  // namespace vitrine
