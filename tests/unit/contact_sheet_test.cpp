// SPDX-License-Identifier: Apache-2.0
#include "stages/contact_sheet.h"

#include "tests/support/pictures.h"

#include <gmock/gmock.h>

namespace vitrine {
namespace {

int red(Image const& sheet, int x, int y) { return sheet.texels[3u * (y * sheet.width + x)]; }

TEST(ContactSheet, EightViewsStandInAColumn) {
  std::vector<Image> const views(10, test::empty_picture(16));
  Image const sheet = contact_sheet(views, views);
  EXPECT_EQ(sheet.width, 2 * 3 * 16);
  EXPECT_EQ(sheet.height, 8 * 16);
  EXPECT_EQ(sheet.channels, 3);
}

TEST(ContactSheet, ShowsBothAndTheirAmplifiedSquaredDifference) {
  Image a = test::empty_picture(16), b = a;
  a.texels[0] = 51, b.texels[0] = 0;
  Image const sheet = contact_sheet({a}, {b});
  EXPECT_EQ(red(sheet, 0, 0), 51);
  EXPECT_EQ(red(sheet, 16, 0), 0);
  EXPECT_EQ(red(sheet, 32, 0), 82);  // 8 x 0.2 x 0.2 of 255
  EXPECT_EQ(red(sheet, 33, 0), 0);
}

TEST(ContactSheet, TheDifferenceSaturates) {
  Image a = test::empty_picture(16), b = a;
  a.texels[0] = 0;
  EXPECT_EQ(red(contact_sheet({a}, {b}), 32, 0), 255);
}

}  // namespace
}  // namespace vitrine
