// SPDX-License-Identifier: Apache-2.0
// What the objects of the sample archive become: the numbers of tests/golden/sample.tsv, within a twentieth.
// To bless a change: VITRINE_BLESS=1 ctest -R golden, and read the diff.
#include "tests/support/folders.h"
#include "tests/support/rows.h"
#include "tools/sample/write.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cstdlib>
#include <vector>

namespace vitrine {
namespace {

constexpr std::uint64_t kTriangles = 20'000;
constexpr std::uint32_t kSeed = 7;

/// With fixed counts and with the search, as `options` say.
std::vector<graph::ModelRow> convert_sample(std::filesystem::path const& folder, graph::ModelOptions options) {
  options.publish.certificate = false;
  return test::converted(io::read_archive(folder / "archive"), options, {0, 0, folder / "gallery"});
}

graph::ModelOptions fixed_counts() {
  graph::ModelOptions options;
  options.simplify.triangles = 3000;
  options.pack.texture = 256;
  return options;
}

graph::ModelOptions small_files() {
  graph::ModelOptions options;
  options.fit.max_kb = 8;
  return options;
}

/// Of the trial that won.
double error(graph::ModelRow const& row) {
  for (Trial const& trial : row.trials)
    if (trial.bytes == row.bytes.total && trial.recipe == *row.recipe) return trial.error;
  return -1;
}

/// Column by column.
std::vector<double> figures(graph::ModelRow const& fixed, graph::ModelRow const& searched) {
  return {double(fixed.triangles),
          double(fixed.charts),
          fixed.atlas_fill,
          double(fixed.bytes.geometry),
          double(fixed.bytes.colour),
          double(fixed.bytes.normal),
          double(searched.bytes.total),
          error(searched)};
}

TEST(SampleArchive, BecomesWhatItDidBefore) {
  test::TemporaryFolder const folder;
  for (sample::Object const& object : sample::objects())
    sample::write(folder.path() / "archive", object, std::string(object.name),
                  sample::scan(object.parts(kSeed), kTriangles, kSeed));
  auto const fixed = convert_sample(folder.path(), fixed_counts()),
             searched = convert_sample(folder.path(), small_files());
  std::filesystem::path const golden = std::filesystem::path(VITRINE_SOURCE_DIR) / "tests/golden/sample.tsv";
  if (std::getenv("VITRINE_BLESS")) {
    std::string text = "input\ttriangles\tcharts\tfill\tgeometry\tcolour\tnormal\tsearched\terror\n";
    for (std::size_t i = 0; i < fixed.size(); ++i)
      text += fmt::format("{}\t{:.5g}\n", fixed[i].input, fmt::join(figures(fixed[i], searched[i]), "\t"));
    test::write_file(golden, text);
  }
  auto const expected = test::manifest(golden);
  ASSERT_EQ(fixed.size(), expected.size());
  for (std::size_t i = 0; i < fixed.size(); ++i) {
    SCOPED_TRACE(fixed[i].input);
    ASSERT_EQ(fixed[i].status, "done") << describe(fixed[i]);
    ASSERT_EQ(searched[i].status, "done") << describe(searched[i]);
    EXPECT_EQ(fixed[i].input, expected[i][0]);
    std::vector<double> const found = figures(fixed[i], searched[i]);
    for (std::size_t k = 0; k < found.size(); ++k) {
      double const wanted = std::stod(expected[i][k + 1]);
      EXPECT_NEAR(found[k], wanted, 0.05 * wanted + 1e-9) << "column " << k + 1;
    }
  }
}

}  // namespace
}  // namespace vitrine
