// SPDX-License-Identifier: Apache-2.0
#include "stages/verdict.h"

#include <gmock/gmock.h>

namespace vitrine {
namespace {

RivalSeries const few{"webp80", 8, 10'000, 9.0}, some{"webp80", 16, 20'000, 4.0}, many{"webp80", 32, 40'000, 1.0};
std::vector<RivalSeries> const series{few, some, many};

TEST(Verdict, TakesTheCheapestSeriesThatIsAsGoodForItsRival) {
  EXPECT_EQ(verdict(15'000, 5.0, series).rival, some) << "8 frames are cheaper but worse";
  EXPECT_EQ(verdict(15'000, 20.0, series).rival, few);
}

TEST(Verdict, TheThumbnailWinsWithFewerBytesOnly) {
  EXPECT_TRUE(verdict(19'999, 5.0, series).thumbnail_wins);
  EXPECT_FALSE(verdict(20'000, 5.0, series).thumbnail_wins);
  EXPECT_FALSE(verdict(20'001, 5.0, series).thumbnail_wins);
}

TEST(Verdict, ASeriesOfTheSameErrorIsAsGood) { EXPECT_EQ(verdict(1, 4.0, series).rival, some); }

TEST(Verdict, TheThumbnailWinsWhereNoSeriesIsAsGood) {
  Verdict const alone = verdict(1'000'000, 0.5, series);
  EXPECT_TRUE(alone.thumbnail_wins);
  EXPECT_FALSE(alone.rival);
  EXPECT_TRUE(verdict(1, 0.5, {}).thumbnail_wins);
}

TEST(Verdict, OfTwoThatCostTheSameTheOneWithFewerFramesIsTheRival) {
  RivalSeries const same{"jpeg90", 8, 20'000, 3.0};
  EXPECT_EQ(verdict(1, 5.0, {some, same}).rival, same);
  EXPECT_EQ(verdict(1, 5.0, {same, some}).rival, same);
}

}  // namespace
}  // namespace vitrine
