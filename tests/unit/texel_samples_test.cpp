// SPDX-License-Identifier: Apache-2.0
#include "stages/texel_samples.h"

#include "tests/support/atlases.h"
#include "tests/support/meshes.h"

#include <gmock/gmock.h>

namespace vitrine {
namespace {

/// One right triangle over the upper left half of a square of texels.
Atlas half_square(int size) {
  return {test::triangle(), {0}, 1, {{V2f(0, 1), V2f(1, 0), V2f(0, 0)}}, size, size, 1, 0.5f};
}

std::uint32_t samples_of(TexelTile const& tile, int x, int y) {
  std::size_t const t = std::size_t(y) * tile.width + x;
  return tile.first[t + 1] - tile.first[t];
}

TEST(TexelSamples, ACoveredTexelHasItsWholeGrid) {
  TexelTile const tile = AtlasRaster(half_square(8), 3).sample(0);
  EXPECT_EQ(samples_of(tile, 0, 0), 9u);
  EXPECT_EQ(samples_of(tile, 3, 3), 9u);
}

TEST(TexelSamples, ATexelOnTheEdgeHasWhatLiesInside) {
  TexelTile const tile = AtlasRaster(half_square(8), 3).sample(0);
  EXPECT_EQ(samples_of(tile, 4, 3), 6u);
}

TEST(TexelSamples, ATexelInBilinearReachHasTheClosestPlace) {
  TexelTile const tile = AtlasRaster(half_square(8), 3).sample(0);
  ASSERT_EQ(samples_of(tile, 5, 3), 1u);
  Barycentric const at =
      tile.samples[tile.first[3 * 8 + 5]].at;  // centre (5.5, 3.5), closest (5, 3): along the hypotenuse
  EXPECT_FLOAT_EQ(at.u, 0.625f);
  EXPECT_NEAR(at.v, 0, 1e-6f);
  EXPECT_EQ(samples_of(tile, 7, 7), 0u);
}

TEST(TexelSamples, CentresAreWhereTexelCentresLie) {
  TexelTile const tile = AtlasRaster(half_square(8), 1).sample(0);
  SurfacePoint const& centre = tile.centres[2 * 8 + 1];
  V2f const uv = interpolate(V2f(0, 1), V2f(1, 0), V2f(0, 0), centre.at);
  EXPECT_NEAR((uv - V2f(1.5f / 8, 2.5f / 8)).length(), 0, 1e-6f);
}

TEST(TexelSamples, AChartWithoutAreaStillReachesItsTexels) {
  Atlas atlas = half_square(8);
  atlas.corner_uvs[0] = {V2f(0.1f, 0.5f), V2f(0.9f, 0.5f), V2f(0.5f, 0.5f)};
  TexelTile const tile = AtlasRaster(atlas, 3).sample(0);
  EXPECT_EQ(tile.covered, 0u);
  EXPECT_EQ(samples_of(tile, 4, 4), 1u);
  EXPECT_EQ(samples_of(tile, 4, 3), 1u);
}

TEST(TexelSamples, EveryTexelThatBilinearLookupReadsIsReached) {
  Atlas const atlas = test::scattered_atlas(test::sphere(8, 6), 75);
  AtlasRaster const raster(atlas, 2);
  std::vector<bool> reached(75 * 75);
  for (std::size_t i = 0; i < raster.tiles(); ++i) {
    TexelTile const tile = raster.sample(i);
    for (int y = 0; y < tile.height; ++y)
      for (int x = 0; x < tile.width; ++x) reached[(tile.y + y) * 75 + tile.x + x] = samples_of(tile, x, y) > 0;
  }
  for (CornerUvs const& uv : atlas.corner_uvs)
    for (int i = 0; i <= 20; ++i)
      for (int j = 0; i + j <= 20; ++j) {
        V2f const at = interpolate(uv[0], uv[1], uv[2], Barycentric{float(i) / 20, float(j) / 20}) * 75.f - V2f(0.5f);
        for (int k = 0; k < 4; ++k) {
          int const x = std::clamp(int(std::floor(at.x)) + k % 2, 0, 74),
                    y = std::clamp(int(std::floor(at.y)) + k / 2, 0, 74);
          ASSERT_TRUE(reached[y * 75 + x]) << x << ' ' << y;
        }
      }
}

TEST(TexelSamples, SamplesOfASharedEdgeBelongToOneFace) {
  TriMesh const square{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  Atlas atlas{square, {0, 0}, 1, {{V2f(0, 1), V2f(1, 1), V2f(1, 0)}, {V2f(0, 1), V2f(1, 0), V2f(0, 0)}}, 8, 8, 1, 1};
  TexelTile const tile = AtlasRaster(atlas, 3).sample(0);
  EXPECT_EQ(tile.samples.size(), 64u * 9);
  EXPECT_EQ(tile.covered, 64u);
}

}  // namespace
}  // namespace vitrine
