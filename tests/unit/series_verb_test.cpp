// SPDX-License-Identifier: Apache-2.0
#include "tools/series.h"

#include "stages/error.h"
#include "tests/support/folders.h"
#include "tests/support/meshes.h"

#include <gmock/gmock.h>

namespace vitrine::tools {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Json = nlohmann::ordered_json;

class SeriesVerb : public testing::Test {
 protected:
  void add_picture(std::string const& name, std::uint8_t shade) {
    Image const picture{60, 40, 3, ColourSpace::srgb, std::vector<std::uint8_t>(60 * 40 * 3, shade)};
    std::vector<std::byte> const png = io::encode_image(picture, {io::ImageCodec::png}).bytes;
    test::write_file(photos / name, {reinterpret_cast<char const*>(png.data()), png.size()});
  }
  SeriesCommand from_photos() const {
    SeriesCommand command;
    command.pictures = photos;
    command.out = out;
    command.measure.size = 30;
    return command;
  }
  Json manifest() const { return Json::parse(test::read_file(out / "series.json")); }
  std::string refusal(SeriesCommand const& command) const {
    try {
      series(command);
    } catch (Error const& error) {
      return error.what();
    }
    return "";
  }

  test::TemporaryFolder const folder;
  std::filesystem::path const photos = folder.path() / "photos", out = folder.path() / "out";
};

TEST_F(SeriesVerb, DrawsAModel) {
  SeriesCommand command;
  command.original = folder.path() / "ball.OBJ";
  test::write_file(command.original, test::obj_text(test::painted_model(test::bumpy_sphere(16, 8))));
  command.out = out;
  command.measure.size = 30;
  command.series.frames = 4;
  EXPECT_EQ(series(command), 0);
  EXPECT_EQ(manifest()["input"], "ball.OBJ");
  EXPECT_EQ(manifest()["files"].size(), 4u);
  EXPECT_THAT(manifest()["elevations"], ElementsAre(10));
}

TEST_F(SeriesVerb, ThePapersSeriesGivesWayToWhatIsGiven) {
  SeriesCommand command;
  command.series.codec = SeriesCodec::webp;
  command.measure.size = 300;
  take_paper_series(command, 16, [](std::string_view flag) { return flag == "--codec"; });
  EXPECT_EQ(command.series.frames, 16);
  EXPECT_EQ(command.measure.size, 200);
  EXPECT_EQ(command.series.codec, SeriesCodec::webp);
  take_paper_series(command, 8, [](std::string_view) { return false; });
  EXPECT_EQ(command.series.frames, 8);
  EXPECT_EQ(command.series.codec, SeriesCodec::jpeg);
  EXPECT_EQ(graph::coding(command.series.codec, graph::usual_quality(command.series.codec)).quality, 90);
}

TEST_F(SeriesVerb, TakesPicturesByTheNumbersInTheirNames) {
  for (char const* name : {"view-10.png", "view-9.png", "view-010b.png", "View-1.JPG", "a.png"}) add_picture(name, 1);
  test::write_file(photos / "notes.txt", "no picture");
  std::vector<std::string> names;
  for (auto const& file : pictures_in(photos)) names.push_back(file.filename());
  EXPECT_THAT(names, ElementsAre("View-1.JPG", "a.png", "view-9.png", "view-10.png", "view-010b.png"));
}

TEST_F(SeriesVerb, TakesEverySoManyPicturesOfEachRow) {
  for (int i = 0; i < 8; ++i) add_picture("p" + std::to_string(i) + ".png", 50);
  SeriesCommand command = from_photos();
  command.series.rows = 2;
  command.series.frames = 2;
  command.all_pictures = false;
  EXPECT_EQ(series(command), 0);
  EXPECT_THAT(manifest()["pictures"], ElementsAre("p0.png", "p2.png", "p4.png", "p6.png"));
  command.series.rows = 3;
  EXPECT_THAT(refusal(command), HasSubstr("8 pictures"));
}

TEST_F(SeriesVerb, MakesPicturesSquareOnWhite) {
  add_picture("p.png", 0);
  EXPECT_EQ(series(from_photos()), 0);
  std::string const jpeg = test::read_file(out / "frame-00-00.jpg");
  Image const frame = io::decode_image(std::as_bytes(std::span(jpeg)), ColourSpace::srgb);
  ASSERT_EQ(frame.width, 30);
  EXPECT_GT(frame.texels[0], 240);
  EXPECT_LT(frame.texels[3 * (15 * 30 + 15)], 15);
}

TEST_F(SeriesVerb, NamesThePictureThatIsDamaged) {
  test::write_file(photos / "half.png", "\x89PNG\r\n\x1A\n");
  EXPECT_THAT(refusal(from_photos()), HasSubstr("half.png"));
}

TEST_F(SeriesVerb, AFolderWithoutPicturesIsRefused) {
  test::write_file(photos / "notes.txt", "no picture");
  EXPECT_THAT(refusal(from_photos()), HasSubstr("no pictures"));
}

TEST_F(SeriesVerb, DoesNotWriteOverThePictures) {
  add_picture("p.png", 0);
  SeriesCommand command = from_photos();
  command.out = photos / "../photos";
  EXPECT_THAT(refusal(command), HasSubstr("same folder"));
}

}  // namespace
}  // namespace vitrine::tools
