// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a model's materials say of it as a whole. Internal to surface.

#include "stages/data.h"

#include <cstdint>
#include <vector>

namespace vitrine {

/// See the members of Surface that are named alike.
struct Looks {
  std::vector<std::uint16_t> in_use;  ///< materials
  bool coloured = false, mapped = false, unlit = false, emissive = false, double_sided = false;
  Rgba uniform_colour{1, 1, 1, 1};
  AlphaMode alpha = AlphaMode::opaque, common_alpha = AlphaMode::opaque;

  explicit Looks(SourceModel const& model);
};

/// What a face covers of what lies behind it.
float coverage(Material const& material, float alpha);

/// As bright under the usual light as what emits is without.
Rgba with_emission(Rgba colour, V3f const& emission);

}  // namespace vitrine
