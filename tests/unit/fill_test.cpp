// SPDX-License-Identifier: Apache-2.0
#include "stages/fill.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

namespace vitrine {
namespace {

TEST(Fill, OneKnownTexelFillsEverything) {
  Layer layer(13, 7, 2);
  layer.at(40)[0] = 0.25f;
  layer.at(40)[1] = 0.75f;
  std::vector<std::uint8_t> known(13 * 7, 0);
  known[40] = 1;
  fill_unknown(layer, known);
  for (std::size_t t = 0; t < known.size(); ++t) {
    EXPECT_FLOAT_EQ(layer.at(t)[0], 0.25f);
    EXPECT_FLOAT_EQ(layer.at(t)[1], 0.75f);
  }
}

TEST(Fill, KnownTexelsStayAndOthersLieBetweenThem) {
  Layer layer(32, 32, 1);
  std::vector<std::uint8_t> known(32 * 32, 0);
  for (int y = 0; y < 32; ++y)
    for (int x : {2, 3, 28, 29}) {
      known[y * 32 + x] = 1;
      *layer.at(y * 32 + x) = x < 16 ? 0.2f : 0.8f;
    }
  fill_unknown(layer, known);
  for (int y = 0; y < 32; ++y) {
    EXPECT_EQ(*layer.at(y * 32 + 3), 0.2f);
    EXPECT_EQ(*layer.at(y * 32 + 28), 0.8f);
    for (int x = 0; x < 31; ++x) EXPECT_LE(*layer.at(y * 32 + x), *layer.at(y * 32 + x + 1) + 1e-6f) << x;
  }
}

TEST(Fill, LeavesALayerOfWhichNothingIsKnown) {
  Layer layer(5, 4, 1);
  fill_unknown(layer, std::vector<std::uint8_t>(20, 0));
  EXPECT_THAT(layer.values, testing::Each(0));
}

}  // namespace
}  // namespace vitrine
