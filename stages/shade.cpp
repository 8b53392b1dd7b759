// SPDX-License-Identifier: Apache-2.0
#include "stages/shade.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vitrine {
namespace {

constexpr float kDirectional = 0.7f, kAmbient = 0.25f;
constexpr float kF0 = 0.04f;

/// Schlick's approximation with the exponential in place of the fifth power.
float fresnel(float dot_vh) { return kF0 + (1 - kF0) * std::exp2((-5.55473f * dot_vh - 6.98316f) * dot_vh); }

/// Share of light from all around that the specular lobe reflects, once or several times, seen at a cosine.
float ambient_reflectance(float dot_nv) { return 0.0771f + dot_nv * (-0.2158f + dot_nv * (0.276f - dot_nv * 0.1244f)); }

/// What light between the facets adds to the lobe.
float multiple_scattering(float dot_nv) { return 1.0028f + dot_nv * (0.0902f - dot_nv * 0.0159f); }

/// Finds the byte by the linear values at which it changes: exact, and no power per pixel.
class SrgbBytes {
 public:
  SrgbBytes() {
    for (std::size_t b = 0; b < starts_.size(); ++b) starts_[b] = linear((float(b) - 0.5f) / 255);
    for (std::size_t i = 0; i < guesses_.size(); ++i) {
      auto const next = std::upper_bound(starts_.begin() + 1, starts_.end(), float(i) / kSteps);
      guesses_[i] = static_cast<std::uint8_t>(next - starts_.begin() - 1);
    }
  }

  std::uint8_t operator()(float value) const {
    float const x = value > 0 ? std::min(value, 1.0f) : 0.0f;  // NaN is black
    std::size_t byte = guesses_[static_cast<std::size_t>(x * kSteps)];
    while (byte < 255 && x >= starts_[byte + 1]) ++byte;
    return static_cast<std::uint8_t>(byte);
  }

 private:
  static constexpr int kSteps = 4096;

  static float linear(float encoded) {
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
  }

  std::array<float, 256> starts_;  ///< least linear value of each byte
  std::array<std::uint8_t, kSteps + 1> guesses_;
};

}  // namespace

V3f shade(V3f const& base_colour, V3f const& normal, V3f const& to_eye, V3f const& to_light) {
  float const dot_nl = std::max(normal.dot(to_light), 0.0f);
  float const dot_nv = std::clamp(normal.dot(to_eye), 0.0f, 1.0f);
  V3f const ambient = base_colour * (kAmbient * (1 - ambient_reflectance(dot_nv)));
  if (dot_nl == 0) return ambient;
  float const reflected = fresnel(std::clamp(to_eye.dot((to_light + to_eye).normalized()), 0.0f, 1.0f));
  float const visible = 0.5f / std::max(dot_nl + dot_nv, 1e-6f);  // Smith's term at roughness 1
  V3f const specular(reflected * visible * multiple_scattering(dot_nv));
  return ambient + (base_colour * (1 - reflected) + specular) * (kDirectional * dot_nl);
}

std::uint8_t srgb_byte(float value) {
  static SrgbBytes const bytes;
  return bytes(value);
}

}  // namespace vitrine
