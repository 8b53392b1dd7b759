// SPDX-License-Identifier: Apache-2.0
// What the objects of the sample archive become: the numbers of tests/golden/sample.tsv, within a twentieth.
// To bless a change: VITRINE_BLESS=1 ctest -R golden, and read the diff.
#include "graph/pipeline.h"
#include "tests/support/folders.h"
#include "tools/sample/write.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cstdlib>
#include <map>

namespace vitrine {
namespace {

constexpr std::uint64_t kTriangles = 20'000;
constexpr std::uint32_t kSeed = 7;

std::vector<graph::ModelRow> convert_sample(std::filesystem::path const& folder) {
  for (sample::Object const& object : sample::objects())
    sample::write(folder / "archive", object, std::string(object.name), sample::scan(object.parts(kSeed), kTriangles, kSeed));
  graph::ModelOptions options;
  options.publish.certificate = false;
  return graph::run_pipeline(io::read_archive(folder / "archive"), options, {0, 0, folder / "gallery"});
}

/// "path \t triangles \t charts \t fill \t geometry \t colour \t normal".
std::string line(graph::ModelRow const& row) {
  return fmt::format("{}\t{}\t{}\t{:.3f}\t{}\t{}\t{}\n", row.input, row.triangles, row.charts, row.atlas_fill,
                     row.bytes.geometry, row.bytes.colour, row.bytes.normal);
}

TEST(SampleArchive, BecomesWhatItDidBefore) {
  test::TemporaryFolder const folder;
  std::vector<graph::ModelRow> const rows = convert_sample(folder.path());
  std::filesystem::path const golden = std::filesystem::path(VITRINE_SOURCE_DIR) / "tests/golden/sample.tsv";
  if (std::getenv("VITRINE_BLESS")) {
    std::string text = "input\ttriangles\tcharts\tfill\tgeometry\tcolour\tnormal\n";
    for (graph::ModelRow const& row : rows) text += line(row);
    test::write_file(golden, text);
  }
  auto const expected = test::manifest(golden);
  ASSERT_EQ(rows.size(), expected.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    graph::ModelRow const& row = rows[i];
    SCOPED_TRACE(row.input);
    ASSERT_EQ(row.status, "done") << describe(row);
    EXPECT_EQ(row.input, expected[i][0]);
    double const found[] = {double(row.triangles),      double(row.charts),       row.atlas_fill,
                            double(row.bytes.geometry), double(row.bytes.colour), double(row.bytes.normal)};
    for (std::size_t k = 0; k < std::size(found); ++k) {
      double const wanted = std::stod(expected[i][k + 1]);
      EXPECT_NEAR(found[k], wanted, 0.05 * wanted + 1e-9) << "column " << k + 1;
    }
  }
}

}  // namespace
}  // namespace vitrine
