// SPDX-License-Identifier: Apache-2.0
#pragma once
/// sRGB as files store it, to linear colours of 16 bits. Internal to io.

#include "stages/data.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace vitrine::io {

/// [0,1] to 16 bits; what is outside is clamped.
inline std::uint16_t unit16(double value) {
  return static_cast<std::uint16_t>(std::lround(65535 * std::clamp(value, 0.0, 1.0)));
}

/// One sRGB channel in [0,1], clamped, to linear 16 bits. Source: IEC 61966-2-1.
inline std::uint16_t linear16(double srgb) {
  double const c = std::clamp(srgb, 0.0, 1.0);
  return unit16(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
}

/// The same of bytes, by table.
inline std::array<std::uint16_t, 256> const kLinear16 = [] {
  std::array<std::uint16_t, 256> values{};
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = linear16(double(i) / 255);
  return values;
}();
inline std::uint16_t linear16(std::uint8_t srgb) { return kLinear16[srgb]; }

}  // namespace vitrine::io
