// SPDX-License-Identifier: Apache-2.0
#include "graph/admission.h"

#include <gmock/gmock.h>

namespace vitrine::graph {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(Admission, LetsInWhatFitsAndHoldsTheRest) {
  Admission admission(100, 10);
  for (std::size_t id : {0, 1, 2}) admission.wait(id, 40);
  EXPECT_THAT(admission.admit(), ElementsAre(0, 1));
  EXPECT_EQ(admission.memory_in_use(), 80);
  EXPECT_THAT(admission.admit(), IsEmpty());
  admission.release(40);
  EXPECT_THAT(admission.admit(), ElementsAre(2));
}

TEST(Admission, BoundsTheNumberOfModelsToo) {
  Admission admission(100, 2);
  for (std::size_t id : {0, 1, 2}) admission.wait(id, 1);
  EXPECT_THAT(admission.admit(), ElementsAre(0, 1));
  EXPECT_EQ(admission.models_in_flight(), 2);
}

TEST(Admission, LetsSmallModelsPassALargeOne) {
  Admission admission(100, 10);
  admission.wait(0, 60);
  admission.wait(1, 90);
  admission.wait(2, 30);
  EXPECT_THAT(admission.admit(), ElementsAre(0, 2));
}

TEST(Admission, NeverStarvesTheLargeOne) {
  Admission admission(100, 10);
  admission.wait(0, 60);
  ASSERT_THAT(admission.admit(), ElementsAre(0));
  admission.wait(1, 90);
  for (std::size_t id = 2; id < 1000; ++id) {
    admission.wait(id, 40);
    for ([[maybe_unused]] std::size_t started : admission.admit()) admission.release(40);
    if (id > 500) {
      EXPECT_EQ(admission.memory_in_use(), 60) << "small models still pass after " << id;
    }
  }
  admission.release(60);
  EXPECT_THAT(admission.admit(), ElementsAre(1));
}

TEST(Admission, SaysWhatCanNeverFit) {
  EXPECT_TRUE(Admission(100, 1).fits_at_all(100));
  EXPECT_FALSE(Admission(100, 1).fits_at_all(101));
}

TEST(Admission, ReadsThisMachinesMemory) { EXPECT_GT(default_memory(), 1u << 20); }

}  // namespace
}  // namespace vitrine::graph
