// SPDX-License-Identifier: Apache-2.0
#include "stages/error.h"
#include "tests/support/certificates.h"
#include "tests/support/folders.h"
#include "tools/report/gallery.h"

#include <gmock/gmock.h>

namespace vitrine::report {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

class PaperGallery : public testing::Test {
 protected:
  void write(std::string const& name, Json const& json) { test::write_file(folder_.path() / name, json.dump()); }
  void write_report(Json rows) {
    write("report.json",
          {{"schema", 1}, {"archive", "/scans"}, {"options", Json::object()}, {"rows", std::move(rows)}});
  }
  Gallery read() { return read_gallery(folder_.path()); }
  std::string refusal() {
    try {
      read();
    } catch (Error const& e) {
      EXPECT_EQ(e.kind(), ErrorKind::invalid_input);
      EXPECT_FALSE(e.remedy().empty());
      return e.what();
    }
    return "none";
  }

 private:
  test::TemporaryFolder folder_;
};

TEST_F(PaperGallery, ReadsWhatCertificatesSay) {
  write_report({test::certified_row("a/lion.ply", "Lion", "a-lion-01"),
                {{"input", "b.obj"}, {"title", "b"}, {"status", "failed"}}});
  write("models/a-lion-01/certificate.json", test::certificate("a/lion.ply", 20000, 4.5));
  Gallery const gallery = read();
  EXPECT_EQ(gallery.archive, "/scans");
  EXPECT_THAT(gallery.left_out, ElementsAre("b.obj"));
  ASSERT_THAT(gallery.models, SizeIs(1));
  Model const& lion = gallery.models[0];
  EXPECT_EQ(lion.title, "Lion");
  EXPECT_EQ(lion.triangles, 250000u);
  EXPECT_TRUE(lion.coloured);
  EXPECT_EQ(lion.thumbnail.bytes, 20000u);
  EXPECT_DOUBLE_EQ(lion.thumbnail.mse1e4, 4.5);
  EXPECT_THAT(lion.thumbnail.series, SizeIs(6));
  EXPECT_EQ(series_bytes(lion.thumbnail, "webp80", 16), 16000u);
  EXPECT_EQ(series_bytes(lion.thumbnail, "avif50", 16), 0u);
}

TEST_F(PaperGallery, SaysWhatIsMissing) {
  EXPECT_THAT(refusal(), HasSubstr("no report.json"));
  write_report({test::certified_row("a.ply", "a", "a-01")});
  EXPECT_THAT(refusal(), HasSubstr("models/a-01/certificate.json"));
  Json damaged = test::certificate("a.ply", 1, 1);
  damaged["measure"].erase("mse1e4");
  write("models/a-01/certificate.json", damaged);
  EXPECT_THAT(refusal(), HasSubstr("mse1e4"));
  damaged["schema"] = 2;
  write("models/a-01/certificate.json", damaged);
  EXPECT_THAT(refusal(), HasSubstr("schema is 2"));
}

TEST_F(PaperGallery, NothingMeasuredIsSaidPlainly) {
  write_report({{{"input", "b.obj"}, {"title", "b"}, {"status", "done"}}});
  EXPECT_THAT(refusal(), HasSubstr("has a certificate"));
}

TEST_F(PaperGallery, AFoldersNameLeadsNowhereElse) {
  write_report({test::certified_row("a.ply", "a", "..")});
  EXPECT_THAT(refusal(), HasSubstr("'..'"));
}

}  // namespace
}  // namespace vitrine::report
