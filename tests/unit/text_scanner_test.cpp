// SPDX-License-Identifier: Apache-2.0
#include "io/text_scanner.h"
#include "tests/support/bytes.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace vitrine {
namespace {

using io::TextScanner;
using testing::ElementsAre;
using testing::HasSubstr;

double number(std::string_view word) { return TextScanner("", "X").number(word); }
std::string refusal(std::string_view word) {
  return test::refusal([&] { return number(word); });
}

TEST(TextScanner, SkipsEmptyLinesAndCountsThem) {
  TextScanner lines("\n  a b \r\n\n\tc", "X");
  ASSERT_TRUE(lines.next_line());
  EXPECT_THAT(lines.words(), ElementsAre("a", "b"));
  ASSERT_TRUE(lines.next_line());
  EXPECT_EQ(lines.rest_of_line(), "c");
  EXPECT_EQ(lines.line(), 4u);
  EXPECT_FALSE(lines.next_line());
}

TEST(TextScanner, LinesMayEndAsMacintoshsEndedThem) {
  TextScanner lines("a\rb\r\rc", "X");
  for (std::string_view const word : {"a", "b", "c"}) {
    ASSERT_TRUE(lines.next_line());
    EXPECT_EQ(lines.rest_of_line(), word);
  }
  EXPECT_EQ(lines.line(), 4u);
  for (std::string_view const text : {"a\rb\nc", "a\r\r\nb\n", "a\r\nb\r\n", ""})
    EXPECT_EQ(io::line_end(text), '\n') << text;
  for (std::string_view const text : {"a\rb", "a\rb\r", "a\rb\rc\n"}) EXPECT_EQ(io::line_end(text), '\r') << text;
}

TEST(TextScanner, CutsCommentsOff) {
  TextScanner lines("# x\n1 # y\n", "X", 0, '#');
  ASSERT_TRUE(lines.next_line());
  EXPECT_EQ(lines.integer(), 1);
  EXPECT_EQ(lines.word(), "");
}

TEST(TextScanner, ReadsNumbersAsFilesWriteThem) {
  EXPECT_EQ(number("-1.5e+2"), -150);
  EXPECT_EQ(number("+.5"), 0.5);
  EXPECT_EQ(number("7."), 7);
  EXPECT_TRUE(std::isnan(number("-nan")));
  EXPECT_EQ(number("inf"), std::numeric_limits<double>::infinity());
}

TEST(TextScanner, NumbersBeyondTheRangeBecomeZeroOrInfinity) {
  EXPECT_EQ(number("1e-400"), 0);
  EXPECT_EQ(number("-1e400"), -std::numeric_limits<double>::infinity());
}

TEST(TextScanner, RefusesWhatIsNoNumber) {
  EXPECT_THAT(refusal("1.#IND"), HasSubstr("\"1.#IND\" is no number"));
  EXPECT_THAT(refusal("+-1"), HasSubstr("no number"));
  EXPECT_THAT(refusal("1,5"), HasSubstr("no number"));
  EXPECT_THAT(refusal(""), HasSubstr("missing"));
}

TEST(TextScanner, ErrorsNameFormatAndLine) {
  TextScanner lines("a\nb\n", "PLY", 10);
  lines.next_line();
  lines.next_line();
  EXPECT_STREQ(lines.error("what").what(), "PLY line 12: what");
}

TEST(TextScanner, ShownWordsAreShortAndPrintable) {
  EXPECT_EQ(io::shown("a\nb"), "\"a?b\"");
  EXPECT_EQ(io::shown(std::string(100, 'x')), "\"" + std::string(40, 'x') + "…\"");
}

}  // namespace
}  // namespace vitrine
