// SPDX-License-Identifier: Apache-2.0
#include "stages/series.h"

#include "stages/error.h"

#include <gmock/gmock.h>

namespace vitrine {
namespace {

using testing::ElementsAre;

Image plain(int size, int channels, std::uint8_t value) {
  return {size, size, channels, ColourSpace::srgb,
          std::vector<std::uint8_t>(std::size_t(size * size * channels), value)};
}

std::vector<std::size_t> shown(int views, int frames, int rows = 1) {
  std::vector<std::size_t> result;
  for (Showing const& s : nearest_frames(directions(ViewSet::turntable, views), series_directions(frames, rows)))
    result.push_back(s.frame);
  return result;
}

TEST(Series, RowsAreSpreadFromTheTurntablesTenDegreesToEighty) {
  EXPECT_THAT(row_elevations(1), ElementsAre(10));
  EXPECT_THAT(row_elevations(2), ElementsAre(10, 80));
  EXPECT_THAT(row_elevations(3), ElementsAre(10, 45, 80));
}

TEST(Series, ASeriesOfOneRowIsTheTurntable) {
  std::vector<V3d> const series = series_directions(32, 1), table = directions(ViewSet::turntable, 32);
  ASSERT_EQ(series.size(), table.size());
  for (std::size_t i = 0; i < table.size(); ++i) EXPECT_TRUE(series[i].equalWithAbsError(table[i], 1e-12)) << i;
}

TEST(Series, SmallerSeriesAreEverySoManyFramesOfLargerOnes) {
  std::vector<V3d> const eight = series_directions(8, 1), large = series_directions(32, 1);
  for (std::size_t i = 0; i < 8; ++i) EXPECT_TRUE(eight[i].equalWithAbsError(large[4 * i], 1e-12)) << i;
}

TEST(Series, TheUpperRowLooksDownFromEightyDegrees) {
  std::vector<V3d> const all = series_directions(4, 2);
  ASSERT_EQ(all.size(), 8u);
  EXPECT_NEAR(all[4].y, 0.98481, 1e-5);
  EXPECT_GT(all[4].z, 0);
  EXPECT_GT(all[5].x, 0);
}

TEST(Series, EachViewIsShownTheNearestFrameAndOfTwoTheFirst) {
  EXPECT_THAT(shown(8, 8), ElementsAre(0, 1, 2, 3, 4, 5, 6, 7));
  EXPECT_THAT(shown(8, 4), ElementsAre(0, 0, 1, 1, 2, 2, 3, 0));
  EXPECT_THAT(shown(12, 4), ElementsAre(0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3, 0));
}

TEST(Series, ViewsFromTheSideAreShownTheLowestRow) { EXPECT_THAT(shown(4, 4, 3), ElementsAre(0, 1, 2, 3)); }

TEST(Series, ErrorIsTheMeanSquareOfColoursAndPassesOverAlpha) {
  std::vector<Image> const views{plain(2, 4, 100), plain(2, 4, 200)}, frames{plain(2, 3, 100), plain(2, 3, 149)};
  EXPECT_EQ(mse1e4(views, frames, {{0, 0}}), 0);
  EXPECT_DOUBLE_EQ(mse1e4(views, frames, {{1, 1}}), 1e4 * 51 * 51 / (255.0 * 255));
  EXPECT_DOUBLE_EQ(mse1e4(views, frames, {{0, 0}, {1, 1}}), 1e4 * 51 * 51 / (255.0 * 255) / 2);
}

TEST(Series, ASheetHoldsFramesLineByLineAndWhiteForTheRest) {
  Image const sheet = sprite_sheet({plain(1, 3, 1), plain(1, 3, 2), plain(1, 3, 3)}, 2);
  EXPECT_EQ(sheet.width, 2);
  EXPECT_EQ(sheet.height, 2);
  EXPECT_THAT(sheet.texels, ElementsAre(1, 1, 1, 2, 2, 2, 3, 3, 3, 255, 255, 255));
}

TEST(Series, ASheetKeepsTheRowsOfItsFramesTogether) {
  Image const left{2, 2, 3, ColourSpace::srgb, {1, 1, 1, 2, 2, 2, 3, 3, 3, 4, 4, 4}};
  Image const sheet = sprite_sheet({left, plain(2, 3, 9)}, 2);
  EXPECT_THAT(sheet.texels, ElementsAre(1, 1, 1, 2, 2, 2, 9, 9, 9, 9, 9, 9, 3, 3, 3, 4, 4, 4, 9, 9, 9, 9, 9, 9));
}

TEST(Series, PicturesOfDifferentShapesAreRefused) {
  EXPECT_THROW(mse1e4({plain(2, 3, 0)}, {plain(3, 3, 0)}, {{0, 0}}), Error);
  EXPECT_THROW(mse1e4({plain(2, 3, 0)}, {plain(2, 1, 0)}, {{0, 0}}), Error);
  EXPECT_THROW(mse1e4({plain(2, 3, 0)}, {plain(2, 3, 0)}, {}), Error);
}

}  // namespace
}  // namespace vitrine
