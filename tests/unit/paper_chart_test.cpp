// SPDX-License-Identifier: Apache-2.0
#include "tools/report/chart.h"

#include <gmock/gmock.h>

namespace vitrine::report {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

TEST(Chart, LinearTicksAreRoundAndReachTheMost) {
  EXPECT_THAT(linear_ticks(7), ElementsAre(0, 1, 2, 3, 4, 5, 6, 7));
  EXPECT_THAT(linear_ticks(0), testing::SizeIs(2)) << "an axis has a length";
  EXPECT_GE(linear_ticks(123.4).back(), 123.4);
  EXPECT_LE(linear_ticks(123.4).size(), 9u);
}

TEST(Chart, LogTicksEncloseTheValues) {
  EXPECT_THAT(log_ticks(3, 40), ElementsAre(2, 5, 10, 20, 50));
  EXPECT_THAT(log_ticks(0.02, 70), ElementsAre(0.01, 0.1, 1, 10, 100)) << "decades alone where there are many";
  EXPECT_THAT(log_ticks(5, 5), ElementsAre(5, 10));
}

TEST(Chart, TicksAreShort) {
  EXPECT_EQ(tick_text(0.05), "0.05");
  EXPECT_EQ(tick_text(500), "500");
}

TEST(Chart, NamesAreTextAndDrawingsHaveWords) {
  Svg const chart = stacked_bars({"bars", "Bytes & more", "What <they> are"}, "KB", {"geometry"}, {{"<script>", {2}}});
  EXPECT_THAT(chart.fragment(), Not(HasSubstr("<script")));
  EXPECT_THAT(chart.fragment(),
              HasSubstr("<title id=\"barst\">Bytes &amp; more</title><desc id=\"barsd\">What &lt;they&gt; are</desc>"));
}

TEST(Chart, AFileStandsByItself) {
  std::string const file = log_curves({"c", "t", "d"}, "x", "y", {{"a", 0, {{1, 1, "p"}}}}).file();
  EXPECT_THAT(file, StartsWith("<svg xmlns=\"http://www.w3.org/2000/svg\""));
  EXPECT_THAT(file, HasSubstr("prefers-color-scheme:dark"));
}

TEST(Chart, WhatALogAxisCannotShowIsLeftOut) {
  Curve const good{"good", 0, {{1, 1, "p"}, {10, 0, "q"}}}, empty{"empty", 1, {{0, 3, "r"}}};
  std::string const svg = log_curves({"c", "t", "d"}, "x", "y", {good, empty}).fragment();
  EXPECT_THAT(svg, HasSubstr(">p<"));
  EXPECT_THAT(svg, Not(HasSubstr(">q<")));
  EXPECT_THAT(svg, Not(HasSubstr(">empty<")));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
}

}  // namespace
}  // namespace vitrine::report
