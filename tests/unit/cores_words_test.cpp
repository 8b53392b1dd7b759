// SPDX-License-Identifier: Apache-2.0
#include "tools/cores_words.h"

#include <gmock/gmock.h>

namespace vitrine::tools {
namespace {

using testing::HasSubstr;

TEST(CoresWords, SayWhatBoundTheRunAndWhy) {
  graph::Occupancy const o{
      .seconds = 10, .available = 20, .computed = 10, .taken = 1, .memory = 8, .writing = 1, .allowed = 2'000'000'000};
  EXPECT_EQ(cores_words(o),
            "bound by memory, of which --memory allows 2.00 GB: 50 % computing, 45 % idle (40 % models waited for "
            "memory, 5 % writing), "
            "5 % taken by other programs");
}

TEST(CoresWords, LeaveOutWhatIsNothing) {
  graph::Occupancy const o{.seconds = 10, .available = 20, .computed = 20};
  EXPECT_EQ(cores_words(o), "bound by the cores: 100 % computing, 0 % idle");
}

TEST(CoresWords, SetWhatWasHeldAgainstWhatWasEstimated) {
  EXPECT_EQ(memory_words({.peak = 1'810'000'000, .admitted = 2'100'000'000, .allowed = 19'000'000'000}),
            "memory: at most 1.81 GB held, where 2.10 GB were estimated; 19.00 GB allowed");
}

TEST(CoresWords, NameTheStagesThatTookMost) {
  std::vector<graph::StageProfile> stages;
  for (char const* name : {"a", "b", "c", "d", "e", "f"}) stages.push_back({name, 1, 1, 0.1, 0, 0});
  stages.back().share = 0.5;
  EXPECT_EQ(stages_words(stages), "time: f 50 %, a 10 %, b 10 %, c 10 %, d 10 %, others 10 %");
  stages.resize(1);
  EXPECT_EQ(stages_words(stages), "time: a 10 %");
}

TEST(CoresWords, ShowEveryStageInATable) {
  std::string const table = stages_html({{"load", 12, 3, 0.25, 0.5, 1'810'000'000}});
  EXPECT_THAT(
      table,
      HasSubstr(
          "<td>load</td><td class=\"number\">12</td><td class=\"number\">3.00 s</td><td class=\"number\">25 %</td>"
          "<td class=\"number\">0.50 s</td><td class=\"number\">1.81 GB</td>"));
  EXPECT_EQ(stages_html({}), "");
}

}  // namespace
}  // namespace vitrine::tools
