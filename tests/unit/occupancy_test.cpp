// SPDX-License-Identifier: Apache-2.0
#include "graph/occupancy.h"

#include <gtest/gtest.h>

namespace vitrine::graph {
namespace {

/// Two cores; a second has passed in which one of them computed.
Occupancy half_idle(Tally& tally, std::uint64_t disk_bytes = 0) {
  tally.pass({1, 1, 0, disk_bytes, 500});
  return tally.take();
}

TEST(Occupancy, IsBoundByTheCoresWhereTheyComputed) {
  Tally tally(2, 1000, 100, {});
  tally.pass({1, 1.9, 0, 0, 0});
  Occupancy const o = tally.take();
  EXPECT_DOUBLE_EQ(o.available, 2);
  EXPECT_DOUBLE_EQ(o.computed, 1.9);
  EXPECT_EQ(bound(o), Bound::cores);
  EXPECT_EQ(bound({}), Bound::nothing);
}

TEST(Occupancy, IsBoundByMemoryWhileAModelWaitsForIt) {
  Tally tally(2, 1000, 100, {});
  Admission admission(1000, 4);
  admission.wait(0, 600), admission.wait(1, 600);
  (void)admission.admit();
  tally.admission(admission);
  Occupancy const o = half_idle(tally);
  EXPECT_DOUBLE_EQ(o.memory, 1);
  EXPECT_EQ(bound(o), Bound::memory);
  EXPECT_EQ(o.most_admitted, 700);
  EXPECT_EQ(o.peak, 500);
}

TEST(Occupancy, IsBoundByTheNumberOfModelsAndNotByMemoryWhereThatIsFull) {
  Tally tally(2, 1000, 100, {});
  Admission admission(1000, 1);
  admission.wait(0, 100), admission.wait(1, 100);
  (void)admission.admit();
  tally.admission(admission);
  EXPECT_EQ(bound(half_idle(tally)), Bound::within);
}

TEST(Occupancy, IsBoundByReadingOnlyWhereBytesCameFromTheDisk) {
  Tally tally(2, 1000, 100, {});
  std::size_t const load = tally.begin("load");
  EXPECT_EQ(bound(half_idle(tally, 4096)), Bound::reading);
  tally.pass({2, 2, 0, 4096, 500});  // from the cache
  EXPECT_EQ(bound(tally.take()), Bound::ending);
  (void)tally.end(load, 0);
}

TEST(Occupancy, IsBoundByWritingWhileAModelIsPublished) {
  Tally tally(2, 1000, 100, {});
  (void)tally.begin("publish");
  EXPECT_EQ(bound(half_idle(tally)), Bound::writing);
}

TEST(Occupancy, WhatOthersTakeIsNotIdle) {
  Tally tally(2, 1000, 100, {});
  tally.pass({1, 1, 5, 0, 0});  // more threads waited than there were cores
  Occupancy const o = tally.take();
  EXPECT_DOUBLE_EQ(o.taken, 1);
  EXPECT_EQ(bound(o), Bound::cores);
}

TEST(Occupancy, AStagesPeakIsThatOfItsOwnTime) {
  Tally tally(2, 1000, 100, {});
  tally.pass({1, 1, 0, 0, 900});
  std::size_t const early = tally.begin("load");
  tally.pass({2, 1, 0, 0, 400});
  std::size_t const late = tally.begin("load");
  EXPECT_EQ(tally.end(early, 300), 400);
  EXPECT_EQ(tally.end(late, 300), 300);
}

TEST(Occupancy, SumsUpWithThePeakOfItsLargest) {
  Occupancy sum{.seconds = 1, .available = 2, .computed = 1, .peak = 10, .admitted = 8};
  sum += {.seconds = 2, .available = 4, .computed = 3, .peak = 7, .admitted = 9};
  EXPECT_DOUBLE_EQ(sum.available, 6);
  EXPECT_DOUBLE_EQ(sum.computed, 4);
  EXPECT_EQ(sum.admitted, 8);
}

}  // namespace
}  // namespace vitrine::graph
