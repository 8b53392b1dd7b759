// SPDX-License-Identifier: Apache-2.0
#include "stages/mip_map.h"

#include "stages/colour.h"

#include <gmock/gmock.h>

#include <limits>

namespace vitrine {
namespace {

using testing::ElementsAre;
using testing::FloatNear;

/// Two texels, black and white.
Image black_and_white() { return {2, 1, 1, ColourSpace::srgb, {0, 255}}; }

float grey(MipMap const& map, V2f uv, float level, Wrap wrap = Wrap::repeat) {
  return map.sample(uv, level, {.wrap_u = wrap, .wrap_v = wrap})[0];
}

TEST(MipMap, TexelCentresReadTheTexels) {
  Image const image = black_and_white();
  MipMap const map(image, ColourSpace::srgb);
  EXPECT_EQ(grey(map, {0.25f, 0.5f}, 0), 0);
  EXPECT_EQ(grey(map, {0.75f, 0.5f}, 0), 1);
  EXPECT_FLOAT_EQ(grey(map, {0.5f, 0.5f}, 0), 0.5f);
}

TEST(MipMap, CoarserLevelsAverageInLinearLight) {
  Image const image = black_and_white();
  EXPECT_NEAR(grey(MipMap(image, ColourSpace::srgb), {0.25f, 0.5f}, 1), 0.5f, 0.003f);
  EXPECT_FLOAT_EQ(grey(MipMap(image, ColourSpace::linear), {0.25f, 0.5f}, 9), 128.f / 255);
}

TEST(MipMap, BetweenLevelsBothCount) {
  Image const image{2, 1, 1, ColourSpace::linear, {0, 254}};
  EXPECT_FLOAT_EQ(grey(MipMap(image, ColourSpace::linear), {0.25f, 0.5f}, 0.5f), 0.25f * 254 / 255);
}

TEST(MipMap, OddSizesAreReadAtTheMiddlesOfTheNewTexels) {
  Image const three{3, 1, 1, ColourSpace::linear, {30, 60, 210}};
  EXPECT_FLOAT_EQ(grey(MipMap(three, ColourSpace::linear), {0.5f, 0.5f}, 1), 60.f / 255);
  Image const five{5, 1, 1, ColourSpace::linear, {10, 30, 110, 200, 240}};
  MipMap const map(five, ColourSpace::linear);
  EXPECT_FLOAT_EQ(grey(map, {0.25f, 0.5f}, 1), 25.f / 255);
  EXPECT_FLOAT_EQ(grey(map, {0.75f, 0.5f}, 1), 210.f / 255);
}

TEST(MipMap, ReadsTheNearestTexelsWhereToldTo) {
  Image const image{4, 1, 1, ColourSpace::linear, {0, 100, 200, 250}};
  MipMap const map(image, ColourSpace::linear);
  TextureUse const magnified{.magnified = Filter::nearest}, minified{.minified = Filter::nearest};
  for (float u : {0.26f, 0.4f, 0.49f}) {
    EXPECT_FLOAT_EQ(map.sample({u, 0.5f}, 0, magnified)[0], 100.f / 255);
    EXPECT_FLOAT_EQ(map.sample({u, 0.5f}, 1, minified)[0], 50.f / 255);
    EXPECT_FLOAT_EQ(map.sample({u, 0.5f}, 0.5f, minified)[0], 75.f / 255);
  }
  EXPECT_FLOAT_EQ(map.sample({1, 0.5f}, 0, {.wrap_u = Wrap::clamp, .magnified = Filter::nearest})[0], 250.f / 255);
  EXPECT_NE(map.sample({0.4f, 0.5f}, 0, minified)[0], 100.f / 255);
}

TEST(MipMap, WrapsAsTold) {
  Image const image = black_and_white();
  MipMap const map(image, ColourSpace::srgb);
  EXPECT_EQ(grey(map, {1.25f, 0.5f}, 0, Wrap::repeat), 0);
  EXPECT_EQ(grey(map, {-0.25f, 0.5f}, 0, Wrap::repeat), 1);
  EXPECT_EQ(grey(map, {1.25f, 0.5f}, 0, Wrap::mirror), 1);
  EXPECT_EQ(grey(map, {-0.25f, 0.5f}, 0, Wrap::mirror), 0);
  EXPECT_EQ(grey(map, {7, 0.5f}, 0, Wrap::clamp), 1);
  EXPECT_FLOAT_EQ(grey(map, {0, 0.5f}, 0, Wrap::repeat), 0.5f);
}

TEST(MipMap, SurvivesCoordinatesBeyondReason) {
  Image const image = black_and_white();
  MipMap const map(image, ColourSpace::srgb);
  float const nan = std::numeric_limits<float>::quiet_NaN();
  for (float const at : {nan, 1e30f, -1e30f, std::numeric_limits<float>::infinity()})
    for (Wrap const wrap : {Wrap::repeat, Wrap::mirror, Wrap::clamp}) {
      float const value = grey(map, {at, at}, at, wrap);
      EXPECT_TRUE(value >= 0 && value <= 1);
    }
}

TEST(MipMap, AlphaIsNeverGammaCoded) {
  Image const image{1, 1, 2, ColourSpace::srgb, {128, 128}};
  float const linear = srgb_to_linear(128.f / 255);
  EXPECT_THAT(MipMap(image, ColourSpace::srgb).sample({0.5f, 0.5f}, 0, {.wrap_u = Wrap::clamp, .wrap_v = Wrap::clamp}),
              ElementsAre(linear, linear, linear, 128.f / 255));
}

TEST(Colour, BytesComeBackFromLinearLight) {
  for (int byte = 0; byte < 256; ++byte) EXPECT_EQ(to_byte(linear_to_srgb(kLinearOfSrgb[byte])), byte);
}

}  // namespace
}  // namespace vitrine
