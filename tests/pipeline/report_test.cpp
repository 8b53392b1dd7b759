// SPDX-License-Identifier: Apache-2.0
// vitrine report on a gallery that vitrine convert made.
#include "tools/report/report.h"
#include "stages/error.h"
#include "tests/support/folders.h"
#include "tests/support/meshes.h"
#include "tests/support/program.h"

#include <gmock/gmock.h>

#include <memory>

namespace vitrine::report {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;

/// One archive and its gallery with a report, made once: a report converts its models several times.
class PaperReport : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<test::TemporaryFolder>();
    test::write_file(archive() / "bowl.obj", test::obj_text(test::painted_model(test::bumpy_sphere(24, 12, 1))));
    test::write_file(archive() / "bust.obj", test::obj_text(test::plain_model(test::bumpy_sphere(24, 12, 2))));
    test::write_file(archive() / "points.obj", "v 0 0 0\nv 1 0 0\n");
    test::write_file(archive() / "archive.csv", "path,title\r\nbowl.obj,<script>alert(1)</script>\r\n");
    convert("gallery");
    run("gallery");
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static fs::path folder() { return folder_->path(); }
  static fs::path archive() { return folder_->path() / "archive"; }
  static fs::path gallery(std::string const& name) { return folder_->path() / name; }
  static std::string file(std::string const& gallery_name, std::string const& name) {
    return test::read_file(gallery(gallery_name) / name);
  }

  static void convert(std::string const& name) {
    test::Program({VITRINE_PROGRAM, "convert", archive(), "--out", gallery(name), "--triangles", "200", "--texture",
                   "64", "--viewport", "40"},
                  folder() / "output")
        .wait();
  }
  static void run(std::string const& name, int threads = 2) {
    ReportCommand command;
    command.gallery = gallery(name);
    command.textures = {64, 32};
    command.run.threads = threads;
    EXPECT_EQ(report(command), 0);
  }

 private:
  inline static std::unique_ptr<test::TemporaryFolder> folder_;
};

TEST_F(PaperReport, GivesTablesFiguresAndPicturesWithNoManualStep) {
  std::string const page = file("gallery", "paper.html");
  EXPECT_THAT(page, HasSubstr("points.obj")) << "what was not converted is named";
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  EXPECT_THAT(page, HasSubstr("paper/figure1-charts.png"));
  EXPECT_THAT(file("gallery", "paper/table4.csv"), HasSubstr("model,32 x 32,64 x 64,this gallery\r\n"));
  EXPECT_THAT(file("gallery", "paper/table4.csv"), Not(HasSubstr(",,"))) << "every setting made every model";
  for (char const* name :
       {"paper/figure1-original.png", "paper/figure1-thumbnail.png", "paper/figure4.svg", "paper/curves.svg"})
    EXPECT_NE(file("gallery", name), "") << name;
}

TEST_F(PaperReport, SaysTheSameAtAnyNumberOfThreads) {
  convert("again");
  run("again", 1);
  for (char const* name : {"paper.html", "paper/curves.svg", "paper/figure1-original.png"})
    EXPECT_EQ(file("gallery", name), file("again", name)) << name;
}

TEST_F(PaperReport, KeepsWhatItHasMade) {
  std::string const first = file("gallery", "paper.html");
  std::vector<fs::path> made;
  for (fs::directory_entry const& entry :
       fs::recursive_directory_iterator(gallery("gallery") / ".vitrine" / "report" / "paper-32"))
    if (entry.path().filename() == "certificate.json") made.push_back(entry.path());
  ASSERT_THAT(made, SizeIs(2));
  auto const time = fs::last_write_time(made[0]);
  test::write_file(made[1], "{}");
  run("gallery");
  EXPECT_EQ(fs::last_write_time(made[0]), time) << "not converted again";
  EXPECT_NE(test::read_file(made[1]), "{}") << "what is damaged is made again";
  EXPECT_EQ(file("gallery", "paper.html"), first);
}

TEST_F(PaperReport, SaysWhatToDoWhenAnOriginalIsGone) {
  fs::rename(archive() / "bowl.obj", folder() / "elsewhere.obj");
  try {
    run("gallery");
    ADD_FAILURE();
  } catch (Error const& e) {
    EXPECT_THAT(e.what(), HasSubstr("bowl.obj"));
    EXPECT_THAT(e.remedy(), HasSubstr("--archive"));
  }
  fs::rename(folder() / "elsewhere.obj", archive() / "bowl.obj");
}

}  // namespace
}  // namespace vitrine::report
