// SPDX-License-Identifier: Apache-2.0
// The page, its tables and its words, of a study made up by hand.
#include "tests/support/certificates.h"
#include "tests/support/folders.h"
#include "tools/report/ablation.h"
#include "tools/report/page.h"
#include "tools/report/page_table.h"
#include "tools/report/paper_tables.h"
#include "tools/report/words.h"

#include <gmock/gmock.h>

namespace vitrine::report {
namespace {

using testing::AnyOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

Thumbnail thumbnail(std::size_t bytes, double mse1e4) {
  return read_thumbnail(test::certificate("x.ply", bytes, mse1e4));
}

Model model(std::string const& title, std::size_t bytes, double mse1e4) {
  return {title + ".ply",
          title,
          title.substr(0, 1),
          "y",
          true,
          5'000'000,
          250'000,
          thumbnail(bytes, mse1e4),
          test::certificate("x.ply", bytes, mse1e4)};
}

/// Two models: one better than 16 frames and smaller, one larger than the 8 frames that are as good.
Study study(std::filesystem::path const& folder = {}) {
  Study study{{folder, "/scans", {}, {model("lion", 12'000, 8.0), model("bowl", 9'000, 25.0)}, {"broken.obj"}}, {}, {}};
  study.trials = {{{"paper-64", true, 64, {}}, {thumbnail(10'000, 10), thumbnail(10'000, 30)}},
                  {{"paper-128", true, 128, {}}, {thumbnail(30'000, 8), thumbnail(30'000, 31)}}};
  return study;
}

TEST(PaperTables, HaveARowForEachModelAndOneForTheMean) {
  Table const bytes = table3(study());
  EXPECT_EQ(to_csv(bytes),
            "model,64 x 64,128 x 128,this gallery,8 views JPEG q90,8 views WebP q80\r\n"
            "lion,10.0,30.0,12.0,8.0,8.0\r\nbowl,10.0,30.0,9.0,8.0,8.0\r\nmean,10.0,30.0,10.5,8.0,8.0\r\n");
  EXPECT_EQ(to_csv(table4(study())),
            "model,64 x 64,128 x 128,this "
            "gallery\r\nlion,10.00,8.00,8.00\r\nbowl,30.00,31.00,25.00\r\nmean,20.00,19.50,16.50\r\n");
}

TEST(PaperTables, AModelThatASettingCouldNotMakeLeavesAGap) {
  Study gap = study();
  gap.trials[0].thumbnails[1].reset();
  EXPECT_THAT(to_csv(table4(gap)), HasSubstr("bowl,,31.00,25.00\r\nmean,10.00,19.50,16.50"));
}

TEST(PaperTables, VerdictsNameTheRival) {
  std::string const csv = to_csv(verdicts(study()));
  EXPECT_THAT(csv, HasSubstr("lion,3D,12.0,8.00,\"16 frames, JPEG q90\",16.0,6.00,series"));
  EXPECT_THAT(csv, HasSubstr("bowl,series,9.0,25.00,\"8 frames, JPEG q90\",8.0,20.00,series"));
}

TEST(PaperTables, AblationTellsWhatAChoiceIsWorth) {
  Study tried = study();
  Setting whole{"own-16", false, 16, {}}, without{"without-refit", false, 16, {}};
  without.options.fit.without = Choice::refit;
  tried.ablation = {{whole, {thumbnail(16'000, 8), thumbnail(16'000, 25)}},
                    {without, {thumbnail(16'000, 16), thumbnail(16'000, 25)}}};
  EXPECT_THAT(to_csv(ablation(tried)), HasSubstr("refit,1.414,0.0000,1,2.000,lion,2.00\r\n"));
}

TEST(PaperTables, APageCountsItsCodeOnceAndPicturesNone) {
  Gallery gallery = study().gallery;
  EXPECT_TRUE(page_table(gallery).rows.empty()) << "galleries that do not say";
  gallery.page = {{"viewer", {{"gzip", 150'000}}},
                  {"decoder", {{"gzip", 50'000}}},
                  {"objects", 10},
                  {"thumbnails", 100'000},
                  {"series", {{"jpeg90", {{"8", 400'000}}}}}};
  EXPECT_EQ(to_csv(page_table(gallery)),
            "objects as,\"first, KB\",\"all, KB\",\"first, s at 1.6 Mbit/s\",\"first, s at 10 Mbit/s\",\"first, s at "
            "50 Mbit/s\","
            "\"all, s at 1.6 Mbit/s\",\"all, s at 10 Mbit/s\",\"all, s at 50 Mbit/s\"\r\n"
            "\"3D, with viewer and decoder\",210.0,300.0,1.05,0.17,0.03,1.50,0.24,0.05\r\n"
            "\"8 pictures, JPEG q90\",40.0,400.0,0.20,0.03,0.01,2.00,0.32,0.06\r\n");
  gallery.page["plain"] = {{"thumbnails", 120'000}};
  EXPECT_THAT(to_csv(page_table(gallery)), HasSubstr("\"3D, with viewer\",162.0,270.0,"));
  gallery.page.erase("plain");
  gallery.page.erase("decoder");
  EXPECT_THAT(to_csv(page_table(gallery)), HasSubstr("\"3D, with viewer\",160.0,250.0,")) << "profiles that need none";
}

TEST(PaperTables, APageTellsHowLongVisitorsWaited) {
  Gallery gallery = study().gallery;
  EXPECT_TRUE(wait_table(gallery).rows.empty()) << "galleries that were not measured";
  gallery.page["measured"] = {{"decoding", 43.2},
                              {"visits",
                               {{{"view", "3d"},
                                 {"megabits", 1.6},
                                 {"latency", 150},
                                 {"poster", 1.53},
                                 {"first", 3.6},
                                 {"all", 5.72},
                                 {"bytes", {{"first", 353'000}, {"all", 493'400}}}}}}};
  EXPECT_THAT(wait_table(gallery).caption, HasSubstr("43 ms"));
  EXPECT_THAT(to_csv(wait_table(gallery)), HasSubstr("\r\n3D,1.6,150,1.5,3.6,353,5.7,493\r\n"));
}

TEST(PaperTables, CodecsHaveTheirUsualNames) {
  EXPECT_EQ(codec_name("jpeg90"), "JPEG q90");
  EXPECT_EQ(codec_name("avif"), "AVIF");
  EXPECT_EQ(codec_name("other7"), "other q7");
}

TEST(Words, SayWhatTheFiguresSay) {
  std::vector<std::string> const said = findings(study());
  EXPECT_THAT(said, Contains(HasSubstr("fewer bytes than any image series for 1 of 2 models")));
  // All deviations from 19.75: 95.06 + 105.06 + 138.06 + 126.56 = 464.75; rows 9 and 30.5: 462.25; columns 20 and 19.5:
  // 0.25.
  EXPECT_THAT(said,
              Contains(HasSubstr("the model explains 99.5 % of the variance of the error and the texture size 0.1 %")));
  EXPECT_THAT(said, Contains(HasSubstr("but for: bowl from 64 to 128 texels (30.00 to 31.00).")));
  EXPECT_THAT(
      said,
      Contains(HasSubstr("on average 25 % of the bytes (25 to 25 %) at 64 texels, 25 % (25 to 25 %) at 128 texels.")));
}

TEST(Words, SayNothingOfTooFewModels) {
  Study alone = study();
  alone.gallery.models.pop_back();
  for (Trial& trial : alone.trials) trial.thumbnails.pop_back();
  EXPECT_THAT(findings(alone), Not(Contains(AnyOf(HasSubstr("variance"), HasSubstr("correlation")))));
}

class PaperPage : public testing::Test {
 protected:
  std::string file(std::string const& name) { return test::read_file(folder_.path() / name); }
  test::TemporaryFolder folder_;
};

TEST_F(PaperPage, HoldsTablesAndFiguresAndNamesNothingThatIsNotThere) {
  publish_page(study(folder_.path()), {"lion", {{"paper/figure1-original.png", "original", 320, 320}}, {{}, {}}});
  std::string const page = file("paper.html");
  for (char const* part : {"Table 1.", "Table 2.", "Table 3.", "Table 4.", "Figure 1.", "Figure 4.", "broken.obj"})
    EXPECT_THAT(page, HasSubstr(part));
  for (char const* name :
       {"paper/table1.csv", "paper/table3.md", "paper/figure4.svg", "paper/curves.svg", "paper/curves-l.svg"}) {
    EXPECT_THAT(page, HasSubstr(name));
    EXPECT_NE(file(name), "") << name;
  }
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  EXPECT_THAT(page, Not(HasSubstr("http")));
}

TEST_F(PaperPage, HostileTitlesStayText) {
  Study hostile = study(folder_.path());
  hostile.gallery.models[0].title = "<img src=x onerror=alert(1)>\"'";
  hostile.gallery.left_out = {"<b>bad</b>"};
  publish_page(hostile, {"<i>", {}, {{}, {}}});
  for (char const* name : {"paper.html", "paper/figure4.svg", "paper/curves-l.svg"}) {
    EXPECT_THAT(file(name), Not(HasSubstr("<img src=x"))) << name;
    EXPECT_THAT(file(name), Not(HasSubstr("<b>"))) << name;
  }
}

}  // namespace
}  // namespace vitrine::report
