// SPDX-License-Identifier: Apache-2.0
#include "graph/series_files.h"

#include "stages/clean.h"
#include "stages/error.h"
#include "tests/support/folders.h"
#include "tests/support/meshes.h"

#include <gmock/gmock.h>

namespace vitrine::graph {
namespace {

using testing::ElementsAre;
using testing::UnorderedElementsAre;
using Json = nlohmann::ordered_json;

SurveyedModel model() {
  SourceModel source = test::painted_model(test::bumpy_sphere(24, 12));
  return survey(std::make_shared<SourceModel const>(clean(std::move(source)).model));
}

SeriesFiles made(SeriesOptions const& options, MeasureOptions measure = {}) {
  measure.size = 24;
  SurveyedModel const original = model();
  return series_files(original, reference(original, measure), options);
}

std::vector<std::string> names(SeriesFiles const& series) {
  std::vector<std::string> result;
  for (SeriesFile const& file : series.files) result.push_back(file.name);
  return result;
}

std::vector<std::string> entries(std::filesystem::path const& folder) {
  std::vector<std::string> result;
  for (auto const& entry : std::filesystem::directory_iterator(folder)) result.push_back(entry.path().filename());
  return result;
}

TEST(SeriesFiles, AreNamedByRowAndFrame) {
  EXPECT_THAT(names(made({.frames = 3, .rows = 2})),
              ElementsAre("frame-00-00.jpg", "frame-00-01.jpg", "frame-00-02.jpg", "frame-01-00.jpg", "frame-01-01.jpg",
                          "frame-01-02.jpg"));
  EXPECT_EQ(names(made({.frames = 120, .codec = SeriesCodec::webp})).at(7), "frame-00-007.webp");
}

TEST(SeriesFiles, TheManifestListsEveryFileWithItsBytes) {
  SeriesFiles const series = made({.frames = 4, .codec = SeriesCodec::avif, .sheet = true, .animated = true});
  ASSERT_THAT(names(series), ElementsAre("frame-00-00.avif", "frame-00-01.avif", "frame-00-02.avif", "frame-00-03.avif",
                                         "sheet.avif", "turn.webp"));
  std::size_t bytes = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    Json const& entry = series.manifest["files"][i];
    EXPECT_EQ(entry["file"], series.files[i].name);
    EXPECT_EQ(entry["bytes"], series.files[i].bytes.size());
    bytes += series.files[i].bytes.size();
  }
  EXPECT_EQ(series.manifest["bytes"], bytes);
  EXPECT_EQ(series.manifest["sheet"]["file"], "sheet.avif");
  EXPECT_EQ(series.manifest["sheet"]["bytes"], series.files[4].bytes.size());
  EXPECT_EQ(series.manifest["animation"]["bytes"], series.files[5].bytes.size());
}

TEST(SeriesFiles, ASheetHoldsEightFramesALine) {
  SeriesFiles const series = made({.frames = 10, .single = false, .sheet = true});
  EXPECT_THAT(names(series), ElementsAre("sheet.jpg"));
  io::ImageSize const size = io::image_size(series.files[0].bytes);
  EXPECT_EQ(size.width, 8 * 24);
  EXPECT_EQ(size.height, 2 * 24);
  EXPECT_EQ(series.manifest["sheet"]["columns"], 8);
  EXPECT_FALSE(series.manifest.contains("files"));
}

TEST(SeriesFiles, FramesThatTheReferenceHasAreThoseThatWouldBeDrawn) {
  MeasureOptions few;
  few.count = 7;  // no divisor: every frame is drawn
  SeriesFiles const reused = made({.frames = 8}), drawn = made({.frames = 8}, few);
  ASSERT_EQ(reused.files.size(), drawn.files.size());
  for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(reused.files[i].bytes, drawn.files[i].bytes) << i;
}

TEST(SeriesFiles, AReferenceWithoutPicturesHasAllFramesDrawn) {
  SurveyedModel const original = model();
  MeasureOptions measure;
  measure.size = 24;
  SeriesFiles const drawn = series_files(original, viewpoints(original, measure), {.frames = 4});
  EXPECT_EQ(drawn.files.at(1).bytes, made({.frames = 4}).files.at(1).bytes);
  EXPECT_FALSE(drawn.manifest.contains("turningMse1e4"));
}

TEST(SeriesFiles, FewerFramesAreFurtherOffWhenTurned) {
  auto const turning = [](int frames) { return made({.frames = frames}).manifest["turningMse1e4"].get<double>(); };
  EXPECT_GT(turning(5), turning(10));
  EXPECT_GT(turning(10), turning(20));
  EXPECT_GT(turning(20), turning(32));
}

TEST(SeriesFiles, WithAFrameForEachViewOnlyTheCodingIsOff) {
  Json const manifest = made({}).manifest;
  EXPECT_EQ(manifest["turningMse1e4"], manifest["codingMse1e4"]);
}

TEST(SeriesFiles, MoreQualityIsLessErrorInMoreBytes) {
  for (SeriesCodec codec : {SeriesCodec::jpeg, SeriesCodec::webp, SeriesCodec::avif}) {
    Json const coarse = made({.frames = 4, .codec = codec, .quality = 20}).manifest;
    Json const fine = made({.frames = 4, .codec = codec, .quality = 95}).manifest;
    EXPECT_GT(coarse["codingMse1e4"], fine["codingMse1e4"]);
    EXPECT_LT(coarse["bytes"], fine["bytes"]);
  }
}

TEST(SeriesFiles, OtherPicturesAreCodedAsTheyAre) {
  std::vector<Image> const pictures(6, Image{20, 20, 3, ColourSpace::srgb, std::vector<std::uint8_t>(1200, 128)});
  SeriesFiles const series = series_files(pictures, {.frames = 3, .rows = 2});
  EXPECT_EQ(series.files.size(), 6u);
  EXPECT_EQ(series.manifest["size"], 20);
  EXPECT_FALSE(series.manifest.contains("turningMse1e4"));
  EXPECT_THROW(series_files(pictures, {.frames = 4}), Error);
}

TEST(SeriesFiles, TooManyPicturesAreRefusedBeforeTheyAreDrawn) {
  EXPECT_THROW(made({.frames = 360, .rows = 3}), Error);
}

TEST(SeriesFiles, ASheetLargerThanItsCodecHoldsIsRefused) {
  std::vector<Image> const pictures(1024,
                                    Image{128, 128, 3, ColourSpace::srgb, std::vector<std::uint8_t>(3 * 128 * 128)});
  SeriesOptions const options{.frames = 256, .rows = 4, .codec = SeriesCodec::webp, .sheet = true};
  try {
    series_files(pictures, options);  // 128 lines of 128 pixels
    FAIL();
  } catch (Error const& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("16384 pixels; webp images have at most 16383"));
  }
}

TEST(SeriesFiles, PublishingLeavesNothingOfAnEarlierSeriesAndNothingElseAway) {
  test::TemporaryFolder const folder;
  test::write_file(folder.path() / "frame-00-99.jpg", "of the user");
  publish_series(folder.path(), made({.frames = 3, .sheet = true, .animated = true}));
  publish_series(folder.path(), made({.frames = 2}));
  EXPECT_THAT(entries(folder.path()),
              UnorderedElementsAre("frame-00-00.jpg", "frame-00-01.jpg", "frame-00-99.jpg", "series.json"));
  Json const written = Json::parse(test::read_file(folder.path() / "series.json"));
  EXPECT_EQ(written["schema"], 1);
  EXPECT_EQ(written["frames"], 2);
}

TEST(SeriesFiles, ASeriesJsonOfSomebodyElseRemovesNothing) {
  test::TemporaryFolder const folder;
  test::write_file(folder.path() / "thumb.glb", "glTF");
  for (char const* text : {R"({"files": [{"file": "thumb.glb"}, {"file": "../x"}, 3, {"file": 4}]})", "[1", "7"}) {
    test::write_file(folder.path() / "series.json", text);
    publish_series(folder.path(), made({.frames = 1}));
    EXPECT_EQ(test::read_file(folder.path() / "thumb.glb"), "glTF");
  }
}

}  // namespace
}  // namespace vitrine::graph
