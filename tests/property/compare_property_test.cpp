// SPDX-License-Identifier: Apache-2.0
#include "stages/compare.h"
#include "tests/support/pictures.h"

#include <gmock/gmock.h>

#include <random>
#include <vector>

namespace vitrine {
namespace {

std::vector<Image> samples() {
  std::vector<Image> pictures{test::empty_picture(40), test::disk_picture(40, 5), test::disk_picture(40, 19)};
  for (unsigned seed = 1; seed <= 3; ++seed) pictures.push_back(test::noisy(test::disk_picture(40, 15), 60, seed));
  return pictures;
}

TEST(CompareProperty, APictureIsEqualToItself) {
  for (Image const& picture : samples()) {
    Difference const d = compare(picture, picture);
    EXPECT_EQ(d.mse1e4, 0);
    EXPECT_EQ(d.psnr, 100);
    EXPECT_NEAR(d.ssim, 1, 1e-12);
    EXPECT_EQ(d.iou, 1);
  }
}

TEST(CompareProperty, OrderDoesNotMatter) {
  for (Image const& a : samples())
    for (Image const& b : samples()) {
      Difference const ab = compare(a, b), ba = compare(b, a);
      EXPECT_EQ(ab.mse1e4, ba.mse1e4);
      EXPECT_EQ(ab.foreground_mse1e4, ba.foreground_mse1e4);
      EXPECT_NEAR(ab.ssim, ba.ssim, 1e-12);
      EXPECT_EQ(ab.iou, ba.iou);
    }
}

TEST(CompareProperty, MoreNoiseIsMoreError) {
  Image const clean = test::disk_picture(40, 17);
  for (unsigned seed = 1; seed <= 5; ++seed) {
    Difference last = compare(clean, clean);
    for (int most : {2, 5, 10, 20, 40, 80}) {
      Difference const now = compare(clean, test::noisy(clean, most, seed));
      EXPECT_GT(now.mse1e4, last.mse1e4) << "seed " << seed << ", noise " << most;
      EXPECT_GE(now.foreground_mse1e4, now.mse1e4) << "seed " << seed << ", noise " << most;
      EXPECT_LT(now.psnr, last.psnr) << "seed " << seed << ", noise " << most;
      EXPECT_LT(now.ssim, last.ssim) << "seed " << seed << ", noise " << most;
      last = now;
    }
  }
}

TEST(CompareProperty, FiguresStayInTheirRanges) {
  for (Image const& a : samples())
    for (Image const& b : samples()) {
      Difference const d = compare(a, b);
      EXPECT_THAT(d.mse1e4, testing::AllOf(testing::Ge(0), testing::Le(1e4)));
      EXPECT_THAT(d.psnr, testing::AllOf(testing::Ge(0), testing::Le(100)));
      EXPECT_THAT(d.ssim, testing::AllOf(testing::Ge(-1), testing::Le(1 + 1e-12)));
      EXPECT_THAT(d.iou, testing::AllOf(testing::Ge(0), testing::Le(1)));
    }
}

}  // namespace
}  // namespace vitrine
