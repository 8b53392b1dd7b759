// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Between sRGB bytes and linear light. Source: IEC 61966-2-1.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace vitrine {

/// [0,1] to [0,1].
inline float srgb_to_linear(float value) {
  return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
}

inline float linear_to_srgb(float value) {
  return value <= 0.0031308f ? 12.92f * value : 1.055f * std::pow(value, 1 / 2.4f) - 0.055f;
}

/// Nearest byte of a value in [0,1]; others are clamped.
inline std::uint8_t to_byte(float value) { return static_cast<std::uint8_t>(std::clamp(value, 0.f, 1.f) * 255 + 0.5f); }

/// Linear light of each sRGB byte.
inline std::array<float, 256> const kLinearOfSrgb = [] {
  std::array<float, 256> table;
  for (int i = 0; i < 256; ++i) table[i] = srgb_to_linear(float(i) / 255);
  return table;
}();

}  // namespace vitrine
