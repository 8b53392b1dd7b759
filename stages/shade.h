// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How a surface looks under the light of the measure: what three.js r187 shows for a white ambient light and a white
/// directional light on its standard material with roughness 1 and metalness 0.

#include "stages/lanes.h"

namespace vitrine {

/// Points of surfaces side by side.
struct Samples {
  LaneVector<3> colour{};  ///< linear base colour; then radiance
  LaneVector<3> normal{};  ///< unit, turned to the side that is seen
  Lanes open{};            ///< share of the ambient light that comes through
  Lanes lit{};             ///< 1, or 0 where the colour is shown as it is
};

/// One direction of sight under one light: what does not depend on the surface is computed once.
/// Source: the shader chunks lights_physical and bsdfs of three.js; the terms that it tabulates are polynomials here,
/// within 0.0034 of its table.
class Shading {
 public:
  /// Both unit.
  Shading(V3f const& to_eye, V3f const& to_light);

  /// Linear radiance: ambient 0.25 and directional 0.7 of the base colour, less what the specular lobe (GGX, F0 0.04)
  /// takes from the diffuse one. `normal`: unit, turned to the side that is seen; `open`: share of the ambient light
  /// that comes through.
  V3f operator()(V3f const& base_colour, V3f const& normal, float open = 1) const;
  void operator()(Samples& samples) const;

 private:
  struct Light {
    float ambient, diffuse, specular;  ///< shares of the base colour; white
  };
  Light light(float dot_nl, float dot_nv) const;

  V3f to_eye_, to_light_;
  float fresnel_;
};

/// The byte that a client writes for a linear value: sRGB encoded, clamped, rounded.
std::uint8_t srgb_byte(float linear);

}  // namespace vitrine
