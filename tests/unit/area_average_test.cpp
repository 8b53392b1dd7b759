// SPDX-License-Identifier: Apache-2.0
#include "stages/area_average.h"

#include "stages/colour.h"

#include <gmock/gmock.h>

namespace vitrine {
namespace {

using testing::ElementsAre;
using Bytes = std::vector<std::uint8_t>;

TEST(AreaAverage, SharesOfALineAddUpToOne) {
  std::vector<double> sums(5);
  for (Overlap const& overlap : overlaps(13, 5)) sums[overlap.to] += overlap.share;
  for (double sum : sums) EXPECT_NEAR(sum, 1, 1e-6);
}

TEST(AreaAverage, MeansAreTakenInLight) {
  Image const half = area_average({2, 1, 3, ColourSpace::srgb, {255, 255, 255, 0, 0, 0}}, 1, 1);
  EXPECT_EQ(half.texels[0], to_byte(linear_to_srgb(0.5f)));
  Image const number = area_average({2, 1, 3, ColourSpace::linear, {255, 255, 255, 0, 0, 0}}, 1, 1);
  EXPECT_EQ(number.texels[0], to_byte(0.5f));
}

TEST(AreaAverage, GreyBecomesColourAndAlphaStays) {
  EXPECT_THAT(area_average({1, 1, 1, ColourSpace::srgb, {77}}, 1, 1).texels, ElementsAre(77, 77, 77));
  EXPECT_THAT(area_average({1, 1, 2, ColourSpace::srgb, {77, 9}}, 1, 1).texels, ElementsAre(77, 77, 77, 9));
}

TEST(AreaAverage, ItsOwnSizeIsTheImageItself) {
  Image const image{2, 2, 4, ColourSpace::srgb, Bytes{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 250, 251, 252, 253}};
  EXPECT_EQ(area_average(image, 2, 2).texels, image.texels);
}

}  // namespace
}  // namespace vitrine
