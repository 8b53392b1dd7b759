// SPDX-License-Identifier: Apache-2.0
#include "stages/angle_error.h"

#include <gtest/gtest.h>

namespace vitrine {
namespace {

Image flat(int side) {
  Image map{side, side, 3, ColourSpace::linear, {}};
  for (int i = 0; i < side * side; ++i) map.texels.insert(map.texels.end(), {128, 128, 255});
  return map;
}

TEST(AngleError, IsNoneBetweenAMapAndItself) {
  AngleError const none = angle_error(flat(4), flat(4));
  EXPECT_EQ(none.p50, 0);
  EXPECT_EQ(none.p99, 0);
}

TEST(AngleError, TellsTheUsualTexelFromTheWorst) {
  Image coded = flat(10);
  for (int i = 0; i < 5; ++i) coded.texels[3 * i] = 255, coded.texels[3 * i + 2] = 128;  // turned by a right angle
  AngleError const error = angle_error(flat(10), coded);
  EXPECT_EQ(error.p50, 0);
  EXPECT_NEAR(error.p99, 90, 1);
}

}  // namespace
}  // namespace vitrine
