// SPDX-License-Identifier: Apache-2.0
// Real models, whole and broken, through the whole graph; skipped where they are not beside the repository.
#include "tests/support/folders.h"
#include "tests/support/rows.h"

#include <gmock/gmock.h>

#include <map>

namespace vitrine::graph {
namespace {

/// By the defaults, but for the certificate.
std::map<std::string, ModelRow> convert(std::filesystem::path const& archive, std::vector<std::string> exclude) {
  ModelOptions model;
  model.publish.certificate = false;
  test::TemporaryFolder const gallery;
  std::map<std::string, ModelRow> rows;
  io::ArchiveOptions options;
  options.exclude = std::move(exclude);
  for (ModelRow const& row : test::converted(io::read_archive(archive, options), model, {0, 0, gallery.path()}))
    rows[row.input] = row;
  return rows;
}

TEST(SharedModels, AllWholeModelsBecomeThumbnails) {
  auto const models = test::shared_models();
  if (models.empty()) GTEST_SKIP() << "no shared models beside the repository";
  auto const rows = convert(models, {"broken/**"});
  for (auto const& cells : test::manifest(models / "MANIFEST.tsv")) {
    ASSERT_TRUE(rows.contains(cells[1])) << cells[1];
    ModelRow const& row = rows.at(cells[1]);
    EXPECT_EQ(row.status, "done") << describe(row);
    EXPECT_EQ(row.source_triangles, std::stoul(cells[4])) << cells[1];
    EXPECT_GT(row.triangles, 0u);
    EXPECT_LE(row.bytes.total, 16000u) << cells[1];
  }
}

TEST(SharedModels, EachBrokenModelGetsWhatItsManifestExpects) {
  auto const models = test::shared_models();
  if (models.empty()) GTEST_SKIP() << "no shared models beside the repository";
  auto const rows = convert(models / "broken", {});
  for (auto const& cells : test::manifest(models / "broken/MANIFEST.tsv")) {
    std::string const path = cells[1].substr(std::string("broken/").size());
    ASSERT_TRUE(rows.contains(path)) << path;
    ModelRow const& row = rows.at(path);
    if (cells[4] == "reject") {
      EXPECT_EQ(row.status, "failed") << path << ": " << cells[5];
    }
    if (row.status == "failed") {
      EXPECT_FALSE(row.failure.reason.empty()) << path;
      EXPECT_FALSE(row.failure.remedy.empty()) << path << ": " << row.failure.reason;
      EXPECT_THAT(row.failure.reason, testing::Not(testing::StartsWith("unexpected"))) << path;
    }
  }
}

}  // namespace
}  // namespace vitrine::graph
