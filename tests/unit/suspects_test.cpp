// SPDX-License-Identifier: Apache-2.0
#include "graph/suspects.h"

#include <gmock/gmock.h>

namespace vitrine::graph {
namespace {

TEST(Suspects, NobodyIsConvictedForDyingInCompany) {
  Suspects suspects;
  EXPECT_FALSE(suspects.died({"a", "b"}, false));
  EXPECT_FALSE(suspects.died({"a", "b"}, false));
  EXPECT_THAT(suspects.all(), testing::ElementsAre("a", "b"));
}

TEST(Suspects, WhoDiesAloneAfterwardsIsIt) {
  Suspects suspects;
  suspects.died({"a", "b"}, false);
  suspects.clear("a");
  EXPECT_EQ(suspects.died({"b"}, false), "b");
  EXPECT_THAT(suspects.all(), testing::IsEmpty());
}

TEST(Suspects, OnceAloneMayBeChance) {
  Suspects suspects;
  EXPECT_FALSE(suspects.died({"a"}, false));
  EXPECT_EQ(suspects.died({"a"}, false), "a");
}

TEST(Suspects, AStrangersSignalIsDoubtedLonger) {
  Suspects suspects;
  EXPECT_FALSE(suspects.died({"a"}, true));
  EXPECT_FALSE(suspects.died({"a"}, true));
  EXPECT_EQ(suspects.died({"a"}, true), "a");
}

}  // namespace
}  // namespace vitrine::graph
