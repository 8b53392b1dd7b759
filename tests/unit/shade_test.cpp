// SPDX-License-Identifier: Apache-2.0
#include "stages/shade.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vitrine {
namespace {

V3f const kUp(0, 0, 1), kSide(1, 0, 0);

TEST(Shade, FacingLightAndEyeIsAmbientPlusDiffusePlusLobe) {
  double const fresnel = 0.04 + 0.96 * std::exp2(-5.55473 - 6.98316);
  double const ambient = 0.25 * 0.5 * (1 - 0.0129);
  double const direct = 0.7 * (0.5 * (1 - fresnel) + fresnel * 0.25 * 1.0771);
  EXPECT_NEAR(Shading(kUp, kUp)(V3f(0.5f), kUp).x, ambient + direct, 1e-5);
}

TEST(Shade, TurnedAwayFromTheLightOnlyTheAmbientRemains) {
  EXPECT_NEAR(Shading(kUp, -kUp)(V3f(1), kUp).y, 0.25 * (1 - 0.0129), 1e-5);
  EXPECT_NEAR(Shading(kUp, kSide)(V3f(1), kUp).y, 0.25 * (1 - 0.0129), 1e-5);
}

TEST(Shade, BlackStillShowsTheLobe) {
  float const value = Shading(kUp, kUp)(V3f(0), kUp).z;
  EXPECT_GT(value, 0.005f);
  EXPECT_LT(value, 0.01f);
}

TEST(Shade, ChannelsAreIndependent) {
  V3f const mixed = Shading(kUp, kUp)({0.1f, 0.5f, 0.9f}, kUp);
  EXPECT_EQ(mixed.y, Shading(kUp, kUp)(V3f(0.5f), kUp).y);
}

}  // namespace
}  // namespace vitrine
