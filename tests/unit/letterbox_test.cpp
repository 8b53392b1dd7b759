// SPDX-License-Identifier: Apache-2.0
#include "stages/letterbox.h"

#include <gmock/gmock.h>

namespace vitrine {
namespace {

using testing::Each;
using testing::ElementsAre;

Image grey(int width, int height, std::vector<std::uint8_t> texels) {
  return {width, height, 1, ColourSpace::srgb, std::move(texels)};
}

std::vector<int> reds(Image const& image) {
  std::vector<int> result;
  for (std::size_t i = 0; i < image.texels.size(); i += 3) result.push_back(image.texels[i]);
  return result;
}

TEST(Letterbox, ASquareOfTheRightSizeStaysAsItIs) {
  Image const picture{2, 2, 3, ColourSpace::srgb, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}};
  EXPECT_EQ(letterbox(picture, 2).texels, picture.texels);
}

TEST(Letterbox, EachTexelIsTheMeanOfThoseBelowIt) {
  EXPECT_THAT(reds(letterbox(grey(4, 4, {0, 8, 100, 100, 4, 4, 100, 100, 20, 20, 0, 0, 20, 20, 0, 255}), 2)),
              ElementsAre(4, 100, 20, 64));
}

TEST(Letterbox, TexelsOnABorderCountByTheirShare) {
  EXPECT_THAT(reds(letterbox(grey(3, 3, {0, 90, 180, 0, 90, 180, 0, 90, 180}), 2)), ElementsAre(30, 150, 30, 150));
}

TEST(Letterbox, AWidePictureGetsWhiteAboveAndBelow) {
  EXPECT_THAT(reds(letterbox(grey(8, 4, std::vector<std::uint8_t>(32, 7)), 4)),
              ElementsAre(255, 255, 255, 255, 7, 7, 7, 7, 7, 7, 7, 7, 255, 255, 255, 255));
}

TEST(Letterbox, ASmallPictureIsNotEnlarged) {
  EXPECT_THAT(reds(letterbox(grey(1, 1, {7}), 3)), ElementsAre(255, 255, 255, 255, 7, 255, 255, 255, 255));
}

TEST(Letterbox, WhatIsTransparentShowsWhite) {
  Image const picture{2, 1, 4, ColourSpace::srgb, {10, 20, 30, 0, 0, 0, 0, 51}};
  std::vector<int> const row = reds(letterbox(picture, 2));
  EXPECT_EQ(row[0], 255);
  EXPECT_EQ(row[1], 204);
}

TEST(Letterbox, AThinLineKeepsATexel) {
  Image const square = letterbox(grey(1000, 1, std::vector<std::uint8_t>(1000, 0)), 10);
  EXPECT_EQ(square.width, 10);
  EXPECT_EQ(square.height, 10);
  EXPECT_EQ(reds(square)[45], 0);
}

TEST(Letterbox, OneColourStaysThatColourAtAnySize) {
  for (int size : {1, 7, 64, 100}) {
    Image const square = letterbox(grey(101, 101, std::vector<std::uint8_t>(101 * 101, 201)), size);
    EXPECT_THAT(square.texels, Each(201)) << size;
  }
}

}  // namespace
}  // namespace vitrine
