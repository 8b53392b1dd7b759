// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Gives the texels between charts smooth values, which cost an image codec little and bleed nothing foreign.

#include <cstdint>
#include <vector>

namespace vitrine {

/// height x width x channels values.
struct Layer {
  int width = 0, height = 0, channels = 0;
  std::vector<float> values;

  Layer() = default;
  Layer(int w, int h, int c) : width(w), height(h), channels(c), values(std::size_t(w) * h * c) {}
  float* at(std::size_t texel) { return &values[texel * channels]; }
  float const* at(std::size_t texel) const { return &values[texel * channels]; }
};

/// Replaces the values of texels that are not `known` (height x width, 0 or 1); the others stay as they are.
/// Source: push-pull, Gortler et al. 1996, "The Lumigraph", section 3.4; each level is then relaxed towards the
/// smoothest surface through the known texels.
void fill_unknown(Layer& layer, std::vector<std::uint8_t> const& known);

}  // namespace vitrine
