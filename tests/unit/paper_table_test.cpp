// SPDX-License-Identifier: Apache-2.0
#include "tools/report/escape.h"
#include "tools/report/table.h"

#include <gmock/gmock.h>

namespace vitrine::report {
namespace {

using testing::HasSubstr;
using testing::Not;

Table hostile() {
  return {
      "table1", "Models", {"model", "triangles"}, {{{"<script>alert(1)</script>"}, {1234567.0, 0}}, {{"=1+1"}, {}}}};
}

TEST(PaperTable, HostileNamesStayText) {
  std::string const page = to_html(hostile());
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  EXPECT_THAT(page, HasSubstr("&lt;script&gt;alert(1)&lt;/script&gt;"));
  EXPECT_EQ(html("\"a' & b\x01\n"), "&quot;a&#39; &amp; b\xEF\xBF\xBD\xEF\xBF\xBD");
}

TEST(PaperTable, MarkdownKeepsItsColumns) {
  EXPECT_EQ(markdown("a|b\nc"), "a\\|b c");
  EXPECT_EQ(markdown("[x](javascript:y)<b>"), "\\[x\\](javascript:y)\\<b\\>");
  EXPECT_THAT(to_markdown(hostile()), HasSubstr("| \\<script\\>alert(1)\\</script\\> | 1,234,567 |"));
}

TEST(PaperTable, CsvDefusesFormulasAndKeepsNumbersPlain) {
  EXPECT_EQ(to_csv(hostile()), "model,triangles\r\n<script>alert(1)</script>,1234567\r\n'=1+1,\r\n");
}

TEST(PaperTable, NumbersAreGroupedForPeople) {
  EXPECT_EQ(shown(Cell(999.0, 0)), "999");
  EXPECT_EQ(shown(Cell(1000.0, 1)), "1,000.0");
  EXPECT_EQ(shown(Cell(-1234.5, 1)), "-1,234.5");
  EXPECT_EQ(shown(Cell()), "\xE2\x80\x93");
}

TEST(PaperTable, NamesAreCutBetweenCharacters) {
  EXPECT_EQ(shortened("bust", 4), "bust");
  EXPECT_EQ(shortened("b\xC3\xBCste", 3), "b\xC3\xBC\xE2\x80\xA6");
}

}  // namespace
}  // namespace vitrine::report
