// SPDX-License-Identifier: Apache-2.0
#include "graph/progress.h"

#include <gtest/gtest.h>

namespace vitrine::graph {
namespace {

TEST(ProgressLine, EstimatesByCostNotByCount) {
  // One of four models took 60 s and was half of all the cost: one more minute to go.
  ProgressState const state{.models = 4, .done = 1, .failed = 0, .cost = 10, .cost_done = 5, .seconds = 60};
  EXPECT_EQ(progress_line(state, 10), "[#####-----] 1/4 models  1.0/min  ETA 00:01:00");
}

TEST(ProgressLine, CountsFailures) {
  ProgressState const state{.models = 2, .done = 2, .failed = 1, .cost = 2, .cost_done = 2, .seconds = 60};
  EXPECT_EQ(progress_line(state, 0), "2/2 models  1 failed  2.0/min");
}

TEST(ProgressLine, PromisesNothingBeforeTheFirstModel) {
  ProgressState const state{.models = 2, .cost = 2, .seconds = 60};
  EXPECT_EQ(progress_line(state, 4), "[----] 0/2 models");
}

}  // namespace
}  // namespace vitrine::graph
