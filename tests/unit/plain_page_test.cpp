// SPDX-License-Identifier: Apache-2.0
#include "tools/plain_page.h"

#include "io/publish.h"
#include "io/write_glb.h"
#include "tests/support/delivered.h"
#include "tests/support/folders.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace vitrine::tools {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

class PlainPage : public testing::Test {
 protected:
  /// A gallery of so many objects, whose page has a decoder of so many bytes.
  Json gallery(std::size_t count, std::size_t decoder, Profile profile = Profile::web) {
    Json shown = {{"objects", Json::array()}, {"page", {{"decoder", {{"gzip", decoder}}}}}};
    for (std::size_t i = 0; i < count; ++i) {
      std::vector<std::byte> const glb = io::encode(test::coloured_model(unsigned(i)), "", {.profile = profile}).glb;
      std::string const path = "models/" + std::to_string(i) + "/thumb.glb";
      io::publish_file(folder_.path() / path, glb);
      shown["objects"].push_back({{"thumb", path}, {"bytes", glb.size()}});
    }
    return shown;
  }
  bool has(char const* name) { return fs::exists(folder_.path() / name); }

  test::TemporaryFolder folder_;
};

TEST_F(PlainPage, FewObjectsComeWithoutTheDecoder) {
  Json shown = gallery(2, 75'000);
  offer_plain(folder_.path(), shown);
  EXPECT_EQ(shown["objects"][1]["plain"]["glb"], "models/1/plain.glb");
  std::size_t const first = shown["objects"][0]["plain"]["bytes"], second = shown["objects"][1]["plain"]["bytes"];
  EXPECT_EQ(fs::file_size(folder_.path() / "models/1/plain.glb"), second);
  EXPECT_EQ(shown["page"]["plain"]["thumbnails"], first + second);
}

TEST_F(PlainPage, ManyObjectsPayForTheDecoderAndPlainFilesGo) {
  Json few = gallery(2, 75'000);
  offer_plain(folder_.path(), few);
  Json many = gallery(20, 75'000);
  offer_plain(folder_.path(), many);
  EXPECT_FALSE(many["page"].contains("plain"));
  EXPECT_FALSE(many["objects"][1].contains("plain"));
  EXPECT_FALSE(has("models/1/plain.glb"));
}

TEST_F(PlainPage, TheBoundIsTheDecoder) {
  Json shown = gallery(3, 75'000);
  offer_plain(folder_.path(), shown);
  std::size_t more = shown["page"]["plain"]["thumbnails"];
  for (Json const& object : shown["objects"]) more -= object["bytes"].get<std::size_t>();
  Json cheaper = gallery(3, more + 1), dearer = gallery(3, more);
  offer_plain(folder_.path(), cheaper);
  EXPECT_TRUE(cheaper["page"].contains("plain"));
  offer_plain(folder_.path(), dearer);
  EXPECT_FALSE(dearer["page"].contains("plain"));
}

TEST_F(PlainPage, ADamagedThumbnailIsLeftToOthers) {
  Json shown = gallery(1, 75'000);
  test::write_file(folder_.path() / "models/0/thumb.glb", "glTF");
  offer_plain(folder_.path(), shown);
  EXPECT_FALSE(shown["page"].contains("plain"));
}

TEST_F(PlainPage, WhatNeedsNoDecoderStays) {
  Json shown = gallery(1, 75'000, Profile::plain);
  offer_plain(folder_.path(), shown);
  EXPECT_FALSE(shown["page"].contains("plain"));
}

}  // namespace
}  // namespace vitrine::tools
