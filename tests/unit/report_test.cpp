// SPDX-License-Identifier: Apache-2.0
#include "graph/report.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace vitrine::graph {
namespace {

using testing::HasSubstr;

ModelRow done() {
  ModelRow row;
  row.input = "a/lion.ply";
  row.title = "Lion";
  row.slug = "a-lion-01234567";
  row.status = "done";
  row.thumb = "models/a-lion-01234567/thumb.glb";
  row.bytes = {10, 4, 3, 2, 0, 1};
  row.seconds = {{"load", 1.0}, {"bake", 3.0}};
  return row;
}

ModelRow failed() {
  ModelRow row;
  row.input = "b.obj";
  row.title = "=cmd|' /C calc'!A0";
  row.failure = {"segment", "chart 12 is not a disk", "try a smaller --feature-share"};
  row.seconds = {{"load", 1.0}};
  return row;
}

TEST(Report, TellsAFailureInOneLine) {
  EXPECT_EQ(describe(failed()), "error: b.obj: segment: chart 12 is not a disk; try a smaller --feature-share");
}

TEST(Report, HasOneRowPerInputInOrder) {
  auto const json = report_json({done(), failed()}, "/archive", {{"triangles", 3000}}, 2.0);
  EXPECT_EQ(json["schema"], 1);
  EXPECT_EQ(json["done"], 1);
  EXPECT_EQ(json["failed"], 1);
  EXPECT_EQ(json["options"]["triangles"], 3000);
  ASSERT_EQ(json["rows"].size(), 2);
  EXPECT_EQ(json["rows"][0]["thumb"], "models/a-lion-01234567/thumb.glb");
  EXPECT_EQ(json["rows"][1]["stage"], "segment");
  EXPECT_EQ(json["rows"][1]["remedy"], "try a smaller --feature-share");
}

TEST(Report, SumsTheTimeOfEachStage) {
  auto const stages = report_json({done(), failed()}, "/archive", {}, 2.0)["stages"];
  ASSERT_EQ(stages.size(), 2);
  EXPECT_EQ(stages[0]["stage"], "load");
  EXPECT_EQ(stages[0]["models"], 2);
  EXPECT_DOUBLE_EQ(stages[0]["seconds"], 2.0);
  EXPECT_DOUBLE_EQ(stages[1]["share"], 0.6);
}

TEST(Report, CsvDefusesFormulasAndQuotes) {
  ModelRow row = failed();
  EXPECT_THAT(report_csv({row}), HasSubstr("b.obj,'=cmd|' /C calc'!A0,failed"));
  row.title = "a \"b\", c";
  EXPECT_THAT(report_csv({row}), HasSubstr("b.obj,\"a \"\"b\"\", c\",failed"));
}

TEST(Report, GalleryShowsWhatIsDone) {
  auto const json = gallery_json({done(), failed()});
  ASSERT_EQ(json["objects"].size(), 1);
  EXPECT_EQ(json["objects"][0]["title"], "Lion");
  EXPECT_EQ(json["objects"][0]["bytes"], 10);
  EXPECT_FALSE(json["objects"][0].contains("mse1e4") || json["objects"][0].contains("series"));
}

TEST(Report, GallerySaysHowGoodItIsAndFromWhereItIsSeen) {
  ModelRow row = done();
  row.measurement.emplace().mean.mse1e4 = 1.5;
  row.sphere = {{1, 2, 3}, 4};
  row.series_folder = "models/a-lion-01234567/series";
  row.series_written = {32, 4, 1000};
  auto const object = gallery_json({row})["objects"][0];
  EXPECT_EQ(object["mse1e4"], 1.5);
  EXPECT_EQ(object["sphere"]["centre"].dump(), "[1.0,2.0,3.0]");
  EXPECT_EQ(object["sphere"]["radius"], 4);
  EXPECT_EQ(object["series"]["manifest"], "models/a-lion-01234567/series/series.json");
  EXPECT_EQ(object["series"]["rows"], 4);
  EXPECT_EQ(object["series"]["bytes"], 1000);
}

}  // namespace
}  // namespace vitrine::graph
