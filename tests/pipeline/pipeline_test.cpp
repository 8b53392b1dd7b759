// SPDX-License-Identifier: Apache-2.0
// Promises of the whole graph over small archives that each test writes.
#include "graph/preset.h"
#include "tests/support/folders.h"
#include "tests/support/meshes.h"
#include "tests/support/rows.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>

namespace vitrine::graph {
namespace {

using testing::Each;
using testing::Field;
using testing::HasSubstr;
using testing::SizeIs;

constexpr std::uint64_t kProgram = 150'000'000;  // what --memory grants the program itself

ModelOptions small_thumbnails() {
  ModelOptions options;
  options.simplify.triangles = 200;
  options.pack.texture = 64;
  options.bake.samples = 4;
  options.publish.certificate = false;
  return options;
}

class Pipeline : public testing::Test {
 protected:
  void add(std::string const& name, SourceModel const& model) { add_text(name, test::obj_text(model)); }
  void add_text(std::string const& name, std::string const& text) {
    test::write_file(folder_.path() / "archive" / name, text);
  }
  io::Archive archive(io::ArchiveOptions const& options = {}) {
    return io::read_archive(folder_.path() / "archive", options);
  }

  std::vector<ModelRow> run(io::Archive const& archive, std::string const& gallery = "gallery", int threads = 2,
                            std::uint64_t memory = 0, ModelOptions const& options = small_thumbnails()) {
    return test::converted(archive, options, {threads, memory, folder_.path() / gallery});
  }
  std::string file(std::string const& path, std::string const& gallery = "gallery") {
    return test::read_file(folder_.path() / gallery / path);
  }
  std::string thumb(ModelRow const& row, std::string const& gallery = "gallery") { return file(row.thumb, gallery); }

 private:
  test::TemporaryFolder folder_;
};

TEST_F(Pipeline, NModelsInNRowsOutInTheArchivesOrder) {
  for (char const* name : {"c.obj", "a.obj", "b/d.obj"}) add(name, test::painted_model(test::bumpy_sphere(24, 12)));
  std::vector<ModelRow> const rows = run(archive());
  ASSERT_THAT(rows, SizeIs(3));
  EXPECT_EQ(rows[0].input, "a.obj");
  EXPECT_EQ(rows[1].input, "b/d.obj");
  EXPECT_EQ(rows[2].input, "c.obj");
  for (ModelRow const& row : rows) {
    EXPECT_EQ(row.status, "done") << describe(row);
    EXPECT_EQ(thumb(row).size(), row.bytes.total);
    EXPECT_EQ(row.bytes.geometry + row.bytes.colour + row.bytes.normal + row.bytes.occlusion + row.bytes.other,
              row.bytes.total);
    EXPECT_LE(row.triangles, 200u);
  }
}

TEST_F(Pipeline, ABadModelCostsItsOwnRowAndNothingElse) {
  add("good.obj", test::plain_model(test::torus()));
  add_text("empty.ply", "");
  add_text("points.obj", "v 0 0 0\nv 1 0 0\n");
  std::vector<ModelRow> const rows = run(archive());
  ASSERT_THAT(rows, SizeIs(3));
  EXPECT_EQ(rows[0].status, "failed");
  EXPECT_EQ(rows[0].failure.stage, "load");
  EXPECT_FALSE(rows[0].failure.reason.empty());
  EXPECT_FALSE(rows[0].failure.remedy.empty());
  EXPECT_EQ(rows[1].status, "done");
  EXPECT_EQ(rows[2].status, "failed");
}

TEST_F(Pipeline, SameBytesAtAnyThreadCountAndInAnyOrder) {
  add("a.obj", test::painted_model(test::bumpy_sphere(48, 24, 1)));
  add("b.obj", test::plain_model(test::bumpy_sphere(48, 24, 2)));
  add("c.obj", test::painted_model(test::torus()));
  add("d.obj", test::plain_model(test::two_shells()));
  io::Archive entries = archive();
  std::map<std::string, std::string> expected;
  for (ModelRow const& row : run(entries, "one", 1)) expected[row.input] = thumb(row, "one");
  std::reverse(entries.entries.begin(), entries.entries.end());
  for (ModelRow const& row : run(entries, "two", 2)) {
    EXPECT_FALSE(expected[row.input].empty());
    EXPECT_EQ(thumb(row, "two"), expected[row.input]) << row.input;
  }
}

TEST_F(Pipeline, RefusesAModelThatMemoryCannotHoldAndSaysHowMuchItNeeds) {
  add("small.obj", test::plain_model(test::cube()));
  add("large.obj", test::plain_model(test::sphere(512, 256)));
  io::Archive const entries = archive();
  std::uint64_t const between = kProgram + entries.entries[0].estimate.memory - 1;
  ASSERT_GT(between, kProgram + entries.entries[1].estimate.memory);
  std::vector<ModelRow> const rows = run(entries, "gallery", 2, between);
  EXPECT_EQ(rows[0].failure.stage, "admit");
  EXPECT_THAT(rows[0].failure.remedy, HasSubstr("--memory"));
  EXPECT_EQ(rows[1].status, "done") << describe(rows[1]);
}

TEST_F(Pipeline, FinishesWhenMemoryHoldsOneModelAtATime) {
  for (int i = 0; i < 12; ++i) add(std::to_string(i) + ".obj", test::plain_model(test::torus()));
  io::Archive const entries = archive();
  EXPECT_THAT(run(entries, "gallery", 2, kProgram + entries.entries[0].estimate.memory),
              Each(Field(&ModelRow::status, "done")));
}

TEST_F(Pipeline, TakesTitlesAndUpAxesFromTheArchivesTable) {
  add("a.obj", test::plain_model(test::open_cone()));
  add("b.obj", test::plain_model(test::open_cone()));
  add_text("archive.csv", "path,title,up\r\na.obj,\"Cone, open\",z\r\n");
  std::vector<ModelRow> const rows = run(archive());
  EXPECT_EQ(rows[0].title, "Cone, open");
  EXPECT_EQ(rows[1].title, "b");
  EXPECT_NE(thumb(rows[0]), thumb(rows[1])) << "one lies on its side, the other does not";
}

TEST_F(Pipeline, MapsFollowWhatTheModelHas) {
  add("painted.obj", test::painted_model(test::bumpy_sphere(48, 24)));
  add("plain.obj", test::plain_model(test::bumpy_sphere(48, 24)));
  std::vector<ModelRow> rows = run(archive());
  EXPECT_GT(rows[0].bytes.colour, 0u);
  EXPECT_EQ(rows[1].bytes.colour, 0u) << "an uncoloured model gets no baked colour";
  EXPECT_GT(rows[1].bytes.normal, 0u);
  EXPECT_EQ(rows[1].bytes.occlusion, 0u);

  ModelOptions options = small_thumbnails();
  options.bake.occlusion = Occlusion::occlusion;
  rows = run(archive(), "occlusion", 2, 0, options);
  EXPECT_GT(rows[1].bytes.occlusion, 0u);
  options.bake.occlusion = Occlusion::colour;
  rows = run(archive(), "grey", 2, 0, options);
  EXPECT_GT(rows[1].bytes.colour, 0u);
}

TEST_F(Pipeline, CertifiesWhatItPublished) {
  add("a.obj", test::painted_model(test::bumpy_sphere(48, 24)));
  ModelOptions options = small_thumbnails();
  options.publish = {};
  ModelRow const row = run(archive(), "gallery", 2, 0, options)[0];
  auto const certificate = nlohmann::json::parse(file(row.certificate));
  EXPECT_EQ(certificate["schema"], 1);
  EXPECT_EQ(certificate["input"]["path"], "a.obj");
  EXPECT_EQ(certificate["input"]["hash"].get<std::string>().size(), 32u);
  EXPECT_EQ(certificate["bytes"]["total"], thumb(row).size());
  EXPECT_GT(certificate["measure"]["mse1e4"], 0.0);
  EXPECT_LT(certificate["measure"]["mse1e4"], 50.0);
  EXPECT_GT(certificate["measure"]["ssim"], 0.9);
  EXPECT_LT(certificate["series"]["webp80"]["8"]["bytes"], certificate["series"]["webp80"]["32"]["bytes"]);
  EXPECT_THAT(certificate["verdict"]["winner"], testing::AnyOf("3d", "series"));
  EXPECT_EQ(file(row.poster).substr(0, 2), "\xFF\xD8") << "a JPEG";
  EXPECT_EQ(run(archive(), "again", 1, 0, options)[0].certificate, row.certificate);
  EXPECT_EQ(file(row.certificate, "again"), file(row.certificate));
}

TEST_F(Pipeline, WritesTheRivalWhenAsked) {
  add("a.obj", test::painted_model(test::bumpy_sphere(24, 12)));
  ModelOptions options = small_thumbnails();
  options.publish.series = true;
  ModelRow const row = run(archive(), "gallery", 2, 0, options)[0];
  auto const manifest = nlohmann::json::parse(file(row.series_folder + "/series.json"));
  EXPECT_EQ(manifest["frames"], 32);
  EXPECT_EQ(file(row.series_folder + "/" + manifest["files"][0]["file"].get<std::string>()).substr(0, 2), "\xFF\xD8");
}

TEST_F(Pipeline, WithThePapersPresetX3domAndOcclusionArePartOfIt) {
  add("a.obj", test::plain_model(test::bumpy_sphere(48, 24)));
  ModelOptions options = with(Preset::paper, small_thumbnails());
  options.publish.certificate = true;
  ModelRow const row = run(archive(), "gallery", 2, 0, options)[0];
  ASSERT_EQ(row.status, "done") << describe(row);
  EXPECT_GT(row.bytes.colour, 0u);
  EXPECT_THAT(file(row.x3d), HasSubstr("binaryGeometry"));
  EXPECT_EQ(file(row.x3d_zip).size(), row.x3d_bytes);
  auto const certificate = nlohmann::json::parse(file(row.certificate));
  EXPECT_EQ(certificate["x3dBytes"], row.x3d_bytes);
  EXPECT_EQ(certificate["measure"]["ao"], "colour");
  EXPECT_LT(certificate["measure"]["mse1e4"], 50.0) << "both sides with the same occlusion";
  EXPECT_EQ(file(row.x3d_zip), file(run(archive(), "again", 1, 0, options)[0].x3d_zip, "again"));
}

TEST_F(Pipeline, NamesTheFilesThatAModelIsMadeOf) {
  add_text("a.obj", "mtllib a.mtl\nmtllib missing.mtl\n" + test::obj_text(test::plain_model(test::cube())));
  add_text("a.mtl", "newmtl red\nKd 1 0 0\n");
  io::Dependencies const found = run(archive())[0].dependencies;
  EXPECT_THAT(found, testing::UnorderedElementsAre(testing::Pair("a.mtl", testing::SizeIs(32)),
                                                   testing::Pair("missing.mtl", "")));
}

// ---- The search

ModelOptions searched(double max_kb) {
  ModelOptions options;
  options.fit.max_kb = max_kb;
  options.publish.certificate = false;
  return options;
}

TEST_F(Pipeline, SearchesWhatFitsTheCeiling) {
  add("painted.obj", test::painted_model(test::bumpy_sphere(96, 48)));
  add("plain.obj", test::plain_model(test::bumpy_sphere(96, 48)));
  for (ModelRow const& row : run(archive(), "gallery", 2, 0, searched(4))) {
    ASSERT_EQ(row.status, "done") << describe(row);
    EXPECT_LE(row.bytes.total, 4000u);
    EXPECT_GT(row.bytes.total, 3500u);
    EXPECT_EQ(thumb(row).size(), row.bytes.total);
    ASSERT_TRUE(row.recipe);
    EXPECT_GT(row.trials.size(), 2u);
  }
}

TEST_F(Pipeline, SearchesTheSameAtAnyThreadCount) {
  add("a.obj", test::painted_model(test::bumpy_sphere(64, 32)));
  add("b.obj", test::plain_model(test::torus()));
  std::vector<ModelRow> const one = run(archive(), "one", 1, 0, searched(3)),
                              two = run(archive(), "two", 2, 0, searched(3));
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].recipe, two[i].recipe);
    EXPECT_EQ(thumb(one[i], "one"), thumb(two[i], "two"));
  }
}

TEST_F(Pipeline, SpendsNoMoreThanADeviationOrAnErrorNeeds) {
  add("a.obj", test::plain_model(test::bumpy_sphere(96, 48)));
  ModelOptions loose = searched(100), strict = loose;
  loose.fit.max_deviation = 0.02, strict.fit.max_deviation = 0.005;
  ModelRow const few = run(archive(), "few", 2, 0, loose)[0], many = run(archive(), "many", 2, 0, strict)[0];
  ASSERT_EQ(many.status, "done") << describe(many);
  EXPECT_LT(few.triangles, many.triangles);
  EXPECT_LT(few.bytes.total, many.bytes.total);

  ModelOptions error = searched(100);
  error.fit.max_error = 0.3;
  error.publish.certificate = true;
  ModelRow const row = run(archive(), "error", 2, 0, error)[0];
  ASSERT_EQ(row.status, "done") << describe(row);
  EXPECT_LE(row.measurement->mean.mse1e4, 0.3);
  EXPECT_GT(row.measurement->mean.mse1e4, 0.2) << row.triangles;
}

TEST_F(Pipeline, SaysWhenACeilingCannotBeMet) {
  add("a.obj", test::painted_model(test::bumpy_sphere(64, 32)));
  ModelRow const row = run(archive(), "gallery", 2, 0, searched(0.5))[0];
  EXPECT_EQ(row.failure.stage, "search");
  EXPECT_THAT(row.failure.remedy, HasSubstr("--max-kb"));
}

}  // namespace
}  // namespace vitrine::graph
