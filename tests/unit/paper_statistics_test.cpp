// SPDX-License-Identifier: Apache-2.0
#include "tools/report/statistics.h"

#include <gmock/gmock.h>

namespace vitrine::report {
namespace {

using testing::ElementsAre;
using testing::SizeIs;

TEST(Statistics, SharesOfAHandMadeTable) {
  // Mean 5, all deviations 9 + 1 + 1 + 9 = 20; row means 3 and 7: 2 (4 + 4) = 16; column means 4 and 6: 2 (1 + 1) = 4.
  auto const exact = variance_shares({{2, 4}, {6, 8}});
  ASSERT_TRUE(exact);
  EXPECT_DOUBLE_EQ(exact->rows, 0.8);
  EXPECT_DOUBLE_EQ(exact->columns, 0.2);
  EXPECT_NEAR(exact->rest, 0, 1e-12);
  auto const crossed = variance_shares({{1, 3}, {3, 1}});
  ASSERT_TRUE(crossed);
  EXPECT_DOUBLE_EQ(crossed->rest, 1) << "what neither factor alone explains";
}

TEST(Statistics, NothingIsSaidOfTooLittle) {
  EXPECT_FALSE(variance_shares({}));
  EXPECT_FALSE(variance_shares({{1, 2}}));
  EXPECT_FALSE(variance_shares({{1}, {2}}));
  EXPECT_FALSE(variance_shares({{3, 3}, {3, 3}}));
  EXPECT_FALSE(correlation({1, 2}, {1, 2}));
  EXPECT_FALSE(correlation({1, 1, 1}, {1, 2, 3}));
}

TEST(Statistics, CorrelationFollowsSignAndIgnoresScale) {
  EXPECT_DOUBLE_EQ(*correlation({1, 2, 3}, {10, 20, 30}), 1);
  EXPECT_DOUBLE_EQ(*correlation({1, 2, 3}, {5, 4, 3}), -1);
  EXPECT_NEAR(*correlation({1, 2, 3, 4}, {1, -1, -1, 1}), 0, 1e-12);
}

TEST(Statistics, RisesAreExceptionsFromFalling) {
  Values const values{{4, 3, 2}, {4, 5, 5}, {4, {}, 6}};
  std::vector<Rise> const found = rises(values);
  ASSERT_THAT(found, SizeIs(1)) << "equal is no rise, and a gap says nothing";
  EXPECT_EQ(found[0].row, 1u);
  EXPECT_EQ(found[0].column, 1u);
}

TEST(Statistics, IncompleteRowsAreLeftOut) {
  EXPECT_THAT(complete_rows({{1, 2}, {3, {}}, {5, 6}}), ElementsAre(ElementsAre(1, 2), ElementsAre(5, 6)));
}

TEST(Statistics, GeometricMean) {
  EXPECT_DOUBLE_EQ(geometric_mean({1, 100}), 10);
  EXPECT_DOUBLE_EQ(geometric_mean({0, 100}), 0);
}

}  // namespace
}  // namespace vitrine::report
