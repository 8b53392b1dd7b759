// SPDX-License-Identifier: Apache-2.0
#include "tools/gallery_page.h"

#include "tests/support/folders.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace vitrine::tools {
namespace {

using testing::HasSubstr;
using testing::Not;

graph::ModelRow lion() {
  graph::ModelRow row;
  row.title = "<b>Lion</b> \"of\" stone";
  row.status = "done";
  row.poster = "models/lion/poster.jpg";
  row.metadata = {{"credit", "Museum & Sons"}, {"licence", "CC0"}};
  row.bytes.total = 16000;
  row.series = {{"jpeg90", {{8, 100, 0, 0}, {32, 400, 0, 0}}}};
  return row;
}

graph::ModelRow broken() {
  graph::ModelRow row;
  row.title = "broken";
  row.bytes.total = 7;
  return row;
}

TEST(GalleryPage, HasAllPostersForThoseWithoutScript) {
  std::string const page = with_posters("<main></main>\n<!-- posters -->\n</body>", {lion(), broken()});
  EXPECT_THAT(page, HasSubstr("<main></main>\n<noscript>"));
  EXPECT_THAT(page, HasSubstr("</noscript>\n</body>"));
  EXPECT_THAT(page, HasSubstr("src=\"models/lion/poster.jpg\" alt=\"&lt;b&gt;Lion&lt;/b&gt; &quot;of&quot; stone\""));
  EXPECT_THAT(page, HasSubstr("Museum &amp; Sons, CC0"));
  EXPECT_THAT(page, Not(HasSubstr("<b>")));
  EXPECT_THAT(page, Not(HasSubstr("broken")));
}

TEST(GalleryPage, IsLeftAloneWithoutAPlaceForPosters) {
  EXPECT_EQ(with_posters("<main></main>", {lion()}), "<main></main>");
}

TEST(GalleryPage, WeighsWhatIsDone) {
  test::TemporaryFolder const gallery;
  test::write_file(gallery.path() / "models/lion/poster.jpg", "12345");
  nlohmann::ordered_json const sizes = {{"viewer", {{"bytes", 9}, {"gzip", 3}}},
                                        {"decoders", {{"web", {{"gzip", 5}}}, {"meshopt", {{"gzip", 4}}}}}};
  auto const page = page_weight(gallery.path(), {lion(), broken(), lion()}, Profile::web, sizes);
  EXPECT_EQ(page["viewer"]["gzip"], 3);
  EXPECT_EQ(page["objects"], 2);
  EXPECT_EQ(page["thumbnails"], 32000);
  EXPECT_EQ(page["posters"], 10);
  EXPECT_EQ(page["series"]["jpeg90"]["8"], 200);
  EXPECT_EQ(page["series"]["jpeg90"]["32"], 800);
  EXPECT_EQ(page["decoder"]["gzip"], 5);
  EXPECT_EQ(page_weight(gallery.path(), {lion()}, Profile::meshopt, sizes)["decoder"]["gzip"], 4);
  EXPECT_FALSE(page_weight(gallery.path(), {lion()}, Profile::plain, sizes).contains("decoder"));
}

TEST(GalleryPage, KeepsWhatWasMeasuredOfIt) {
  test::TemporaryFolder const gallery;
  nlohmann::ordered_json const page = {{"objects", 2}, {"posters", 10}};
  auto const kept = [&](nlohmann::ordered_json now) {
    keep_measured(gallery.path(), now);
    return now.contains("measured");
  };
  EXPECT_FALSE(kept(page));
  test::write_file(gallery.path() / "gallery.json",
                   R"({"page": {"objects": 2, "posters": 10, "measured": {"decoding": 43}}})");
  EXPECT_TRUE(kept(page));
  EXPECT_FALSE(kept({{"objects", 2}, {"posters", 11}})) << "of another page";
  test::write_file(gallery.path() / "gallery.json", "{");
  EXPECT_FALSE(kept(page)) << "a damaged file";
}

}  // namespace
}  // namespace vitrine::tools
