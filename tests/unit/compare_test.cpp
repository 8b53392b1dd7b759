// SPDX-License-Identifier: Apache-2.0
#include "stages/compare.h"

#include "stages/error.h"
#include "tests/support/pictures.h"

#include <gmock/gmock.h>

#include <cmath>

namespace vitrine {
namespace {

using test::disk_picture;
using test::empty_picture;

Image one_colour(int size, std::uint8_t value, std::uint8_t coverage) {
  Image picture = empty_picture(size);
  for (std::size_t i = 0; i < picture.texels.size(); ++i) picture.texels[i] = i % 4 == 3 ? coverage : value;
  return picture;
}

TEST(Compare, OneStepEverywhereIsItsSquare) {
  Difference const d = compare(one_colour(16, 100, 255), one_colour(16, 101, 255));
  EXPECT_NEAR(d.mse1e4, 1e4 / (255.0 * 255), 1e-12);
  EXPECT_NEAR(d.foreground_mse1e4, d.mse1e4, 1e-12);
  EXPECT_NEAR(d.psnr, 48.1308, 1e-4);
}

TEST(Compare, BlackAgainstWhiteIsTheLargestError) {
  Difference const d = compare(one_colour(16, 0, 255), one_colour(16, 255, 255));
  EXPECT_DOUBLE_EQ(d.mse1e4, 1e4);
  EXPECT_NEAR(d.psnr, 0, 1e-12);
}

TEST(Compare, FlatPicturesAreSimilarByTheirMeansAlone) {
  double const a = 100 / 255.0, b = 200 / 255.0, c1 = 1e-4;
  Difference const d = compare(one_colour(16, 100, 255), one_colour(16, 200, 255));
  EXPECT_NEAR(d.ssim, (2 * a * b + c1) / (a * a + b * b + c1), 2e-5);
}

/// The definition, window by window, in doubles.
double ssim_by_definition(Image const& a, Image const& b) {
  auto const luminance = [](std::uint8_t const* t) { return (0.299 * t[0] + 0.587 * t[1] + 0.114 * t[2]) / 255; };
  double sum = 0;
  int const last = a.width - 11;
  for (int top = 0; top <= last; ++top)
    for (int left = 0; left <= last; ++left) {
      double weights = 0, ma = 0, mb = 0, aa = 0, bb = 0, ab = 0;
      for (int i = 0; i < 121; ++i) {
        double const dx = i % 11 - 5, dy = i / 11 - 5, weight = std::exp(-(dx * dx + dy * dy) / 4.5);
        std::size_t const texel = 4u * std::size_t((top + i / 11) * a.width + left + i % 11);
        double const va = luminance(&a.texels[texel]), vb = luminance(&b.texels[texel]);
        weights += weight, ma += weight * va, mb += weight * vb;
        aa += weight * va * va, bb += weight * vb * vb, ab += weight * va * vb;
      }
      ma /= weights, mb /= weights;
      double const variances = (aa + bb) / weights - ma * ma - mb * mb, covariance = ab / weights - ma * mb;
      sum += (2 * ma * mb + 1e-4) * (2 * covariance + 9e-4) / ((ma * ma + mb * mb + 1e-4) * (variances + 9e-4));
    }
  return sum / ((last + 1) * (last + 1));
}

TEST(Compare, SimilarityIsThatOfItsDefinition) {
  for (unsigned seed : {1u, 2u}) {
    Image const a = disk_picture(40, 9), b = test::noisy(disk_picture(40, 8), 40, seed);
    EXPECT_NEAR(compare(a, b).ssim, ssim_by_definition(a, b), 1e-5);
  }
}

TEST(Compare, ADifferenceAtTheEdgeCounts) {
  for (int corner : {0, 39, 39 * 40, 40 * 40 - 1}) {
    Image const a = disk_picture(40, 9);
    Image b = a;
    b.texels[4u * std::size_t(corner)] = 0;
    EXPECT_NEAR(compare(a, b).ssim, ssim_by_definition(a, b), 1e-5) << corner;
    EXPECT_LT(compare(a, b).ssim, 1) << corner;
  }
}

TEST(Compare, BackgroundDilutesTheErrorButNotThatOfTheForeground) {
  Image a = empty_picture(20), b = a;
  std::size_t const texel = 4 * (10 * 20 + 10);
  for (Image* image : {&a, &b}) image->texels[texel + 3] = 255;
  a.texels[texel] = 0;
  Difference const d = compare(a, b);
  EXPECT_NEAR(d.foreground_mse1e4, 1e4 / 3, 1e-9);
  EXPECT_NEAR(d.mse1e4, 1e4 / 3 / 400, 1e-9);
}

TEST(Compare, EmptyPicturesAreEqual) {
  Difference const d = compare(empty_picture(16), empty_picture(16));
  EXPECT_EQ(d.mse1e4, 0);
  EXPECT_EQ(d.foreground_mse1e4, 0);
  EXPECT_EQ(d.psnr, 100);
  EXPECT_EQ(d.iou, 1);
  EXPECT_EQ(d.foreground_ssim, 1);
}

TEST(Compare, OverlapCountsPartsOfPixels) {
  EXPECT_DOUBLE_EQ(compare(one_colour(16, 9, 255), one_colour(16, 9, 51)).iou, 0.2);
  EXPECT_EQ(compare(one_colour(16, 9, 255), one_colour(16, 9, 0)).iou, 0);
}

TEST(Compare, MeansAndWorstViewAreThoseOfTheViews) {
  std::vector<Image> const a{one_colour(16, 100, 255), one_colour(16, 100, 255), one_colour(16, 100, 255)};
  std::vector<Image> const b{one_colour(16, 101, 255), one_colour(16, 103, 255), one_colour(16, 102, 255)};
  Comparison const c = compare(a, b);
  EXPECT_EQ(c.worst, 1u);
  EXPECT_NEAR(c.mean.mse1e4, (1 + 9 + 4) / 3.0 * 1e4 / (255.0 * 255), 1e-9);
  EXPECT_NEAR(c.mean.psnr, (c.views[0].psnr + c.views[1].psnr + c.views[2].psnr) / 3, 1e-9);
  EXPECT_LT(c.psnr_of_mean_mse, c.mean.psnr);
}

TEST(Compare, RefusesPicturesOfTwoShapes) { EXPECT_THROW(compare(empty_picture(16), empty_picture(17)), Error); }

TEST(Compare, RefusesPicturesSmallerThanItsWindow) { EXPECT_THROW(compare(empty_picture(8), empty_picture(8)), Error); }

TEST(Compare, RefusesSeriesOfTwoLengths) {
  std::vector<Image> const two(2, empty_picture(16)), three(3, empty_picture(16));
  EXPECT_THROW(compare(two, three), Error);
  EXPECT_THROW(compare(std::vector<Image>{}, {}), Error);
}

}  // namespace
}  // namespace vitrine
