// SPDX-License-Identifier: Apache-2.0
// What a trial takes over from an earlier one.
#include "graph/makings.h"

#include <gtest/gtest.h>

namespace vitrine::graph {
namespace {

Makings made(Recipe const& recipe) {
  Makings makings{recipe,
                  {},
                  std::make_shared<FlatCharts const>(),
                  std::make_shared<Atlas const>(),
                  std::make_shared<BakedModel const>()};
  makings.made.charts = 7;
  return makings;
}

constexpr Recipe kMap{.triangles = 3000, .painting = Painting::map, .texture = 256, .ceiling = 16'000};

TEST(Makings, OfAnotherCodingAreAllOfThem) {
  Recipe other = kMap;
  other.avif = other.full_chroma = other.polished = true, other.ceiling = 8000;
  Makings const shared = made(kMap).shared_with(other);
  EXPECT_EQ(shared.recipe, other);
  EXPECT_EQ(shared.made.charts, 7u);
  EXPECT_TRUE(shared.baked && shared.atlas && shared.charts);
}

TEST(Makings, OfOtherPlacesEndWithTheAtlas) {
  Recipe other = kMap;
  other.position_bits += 1;
  Makings const shared = made(kMap).shared_with(other);
  EXPECT_TRUE(!shared.baked && shared.atlas && shared.charts);
}

TEST(Makings, OfAnotherTextureEndWithTheCharts) {
  Recipe other = kMap;
  other.texture = 320;
  Makings const shared = made(kMap).shared_with(other);
  EXPECT_TRUE(!shared.baked && !shared.atlas && shared.charts);
}

TEST(Makings, OfAnotherShapeAreNone) {
  for (auto const& change :
       {+[](Recipe& r) { r.triangles = 2000; }, +[](Recipe& r) { r.fitted = false; },
        +[](Recipe& r) { r.shading = Shading::smooth; }, +[](Recipe& r) { r.unfolding = Unfolding::rigid; },
        +[](Recipe& r) { r.painting = Painting::own; }}) {
    Recipe other = kMap;
    change(other);
    Makings const shared = made(kMap).shared_with(other);
    EXPECT_TRUE(!shared.baked && !shared.atlas && !shared.charts);
  }
}

}  // namespace
}  // namespace vitrine::graph
