// SPDX-License-Identifier: Apache-2.0
#include "graph/options_json.h"

#include "stages/error.h"

#include <gtest/gtest.h>

namespace vitrine::graph {
namespace {

TEST(OptionsJson, ComeBackAsTheyWere) {
  ModelOptions options;
  options.read.mtl_kd = io::MtlKd::multiply;
  options.simplify.triangles = 777;
  options.simplify.max_error = 0.25;
  options.pack.packing = Packing::boxes;
  options.bake.normal_map = false;
  EXPECT_EQ(options_json(options_from_json(options_json(options))), options_json(options));
  EXPECT_NE(options_json(options), options_json({}));
}

TEST(OptionsJson, WhatIsMissingKeepsItsDefault) {
  EXPECT_EQ(options_json(options_from_json({{"of-tomorrow", 1}})), options_json({}));
}

TEST(OptionsJson, RefuseWhatAnOptionDoesNotHave) {
  EXPECT_THROW(options_from_json({{"packing", "heaps"}}), Error);
  EXPECT_THROW(options_from_json({{"triangles", "many"}}), Error);
}

}  // namespace
}  // namespace vitrine::graph
