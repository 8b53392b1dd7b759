// SPDX-License-Identifier: Apache-2.0
#include "stages/shade.h"

#include "stages/colour.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vitrine {
namespace {

constexpr float kDirectional = 0.7f, kAmbient = 0.25f;
constexpr float kF0 = 0.04f;

/// Schlick's approximation with an exponential in place of the fifth power; `dot_vh`: eye and half-way vector.
float fresnel(float dot_vh) { return kF0 + (1 - kF0) * std::exp2((-5.55473f * dot_vh - 6.98316f) * dot_vh); }

/// Share of light from all around that the specular lobe reflects, once or several times, seen at a cosine.
float ambient_reflectance(float dot_nv) { return 0.0771f + dot_nv * (-0.2158f + dot_nv * (0.276f - dot_nv * 0.1244f)); }

/// By how much light that bounces between the facets brightens the lobe.
float multiple_scattering(float dot_nv) { return 1.0028f + dot_nv * (0.0902f - dot_nv * 0.0159f); }

/// Finds the byte by the linear values at which it changes: exact, and no power per pixel.
struct SrgbBytes {
  static constexpr int kSteps = 4096;  // no two bytes start within one step: the darkest are 1.24 steps apart

  std::array<float, 257> starts;  ///< least linear value of each byte
  std::array<std::uint8_t, kSteps + 1> guesses;

  SrgbBytes() {
    for (int b = 0; b < 256; ++b) starts[b] = srgb_to_linear((float(b) - 0.5f) / 255);
    starts[256] = 2;
    for (int i = 0, byte = 0; i <= kSteps; ++i) {
      while (starts[byte + 1] <= float(i) / kSteps) ++byte;
      guesses[i] = static_cast<std::uint8_t>(byte);
    }
  }
};

SrgbBytes const kSrgbBytes;

}  // namespace

Shading::Shading(V3f const& to_eye, V3f const& to_light)
    : to_eye_(to_eye),
      to_light_(to_light),
      fresnel_(fresnel(std::sqrt(std::max(0.5f + 0.5f * to_eye.dot(to_light), 0.0f)))) {}

inline Shading::Light Shading::light(float dot_nl, float dot_nv) const {
  dot_nl = dot_nl > 0 ? dot_nl : 0;
  dot_nv = dot_nv > 0 ? dot_nv : 0;
  dot_nv = dot_nv < 1 ? dot_nv : 1;
  float const both = dot_nl + dot_nv, visible = 0.5f / (both > 1e-6f ? both : 1e-6f);  // Smith's term at roughness 1
  float const direct = kDirectional * dot_nl;
  return {kAmbient * (1 - ambient_reflectance(dot_nv)), direct * (1 - fresnel_),
          direct * fresnel_ * visible * multiple_scattering(dot_nv)};
}

V3f Shading::operator()(V3f const& base_colour, V3f const& normal, float open) const {
  Light const falls = light(normal.dot(to_light_), normal.dot(to_eye_));
  return base_colour * (falls.ambient * open + falls.diffuse) + V3f(falls.specular);
}

void Shading::operator()(Samples& samples) const {
  auto& [r, g, b] = samples.colour;
  auto const& [x, y, z] = samples.normal;
  for (std::size_t i = 0; i < kLanes; ++i) {
    Light const falls = light(x[i] * to_light_.x + y[i] * to_light_.y + z[i] * to_light_.z,
                              x[i] * to_eye_.x + y[i] * to_eye_.y + z[i] * to_eye_.z);
    float const lit = samples.lit[i], specular = lit * falls.specular;
    float const diffuse = lit * (falls.ambient * samples.open[i] + falls.diffuse) + (1 - lit);
    r[i] = r[i] * diffuse + specular;
    g[i] = g[i] * diffuse + specular;
    b[i] = b[i] * diffuse + specular;
  }
}

std::uint8_t srgb_byte(float linear) {
  float const value = linear > 0 ? std::min(linear, 1.0f) : 0.0f;  // NaN is black
  std::size_t const guess = kSrgbBytes.guesses[static_cast<std::size_t>(value * SrgbBytes::kSteps)];
  return static_cast<std::uint8_t>(guess + (value >= kSrgbBytes.starts[guess + 1]));
}

}  // namespace vitrine
