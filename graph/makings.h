// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a trial was made of: a later one begins behind the last stage that would make the same again.

#include "graph/report.h"
#include "stages/fit.h"

#include <memory>
#include <tuple>

namespace vitrine::graph {

struct Makings {
  Recipe recipe;
  Made made;  ///< what the model's row says of them
  std::shared_ptr<FlatCharts const> charts;
  std::shared_ptr<Atlas const> atlas;
  std::shared_ptr<BakedModel const> baked;

  /// Those of them that another recipe has, too.
  Makings shared_with(Recipe const& other) const {
    auto const shape = [](Recipe const& r) {
      return std::tuple(r.painting, r.triangles, r.colour_weight, r.shading, r.fitted, r.unfolding);
    };
    auto const but_for_coding = [](Recipe r) {
      r.map_quality = r.ceiling = 0;
      r.avif = r.full_chroma = r.polished = false;
      return r;
    };
    bool const same_shape = shape(recipe) == shape(other);
    Makings shared{other, made, charts, atlas, baked};
    if (!same_shape) shared.charts = nullptr;
    if (!same_shape || recipe.texture != other.texture) shared.atlas = nullptr;
    if (but_for_coding(recipe) != but_for_coding(other)) shared.baked = nullptr;
    return shared;
  }
};

}  // namespace vitrine::graph
