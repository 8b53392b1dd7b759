// SPDX-License-Identifier: Apache-2.0
#include "io/write_x3d.h"

#include "io/mesh_codec.h"
#include "io/zip.h"
#include "tests/support/delivered.h"
#include "tests/support/folders.h"
#include "tests/support/meshes.h"

#include <gmock/gmock.h>
#include <zip.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <memory>

namespace vitrine::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

Image plain_image(int channels, ColourSpace space) {
  return {16, 16, channels, space, std::vector<std::uint8_t>(std::size_t(256 * channels), 128)};
}

BakedModel with_maps() {
  BakedModel model = test::random_model(1);
  model.colour = plain_image(3, ColourSpace::srgb);
  model.normal = model.derived_normal = plain_image(3, ColourSpace::linear);
  return model;
}

EncodeOptions paper() {
  EncodeOptions options;
  options.profile = Profile::plain;
  options.x3dom = true;
  return options;
}

std::vector<std::string> names(std::vector<NamedFile> const& files) {
  std::vector<std::string> all;
  for (NamedFile const& file : files) all.push_back(file.name);
  return all;
}

std::vector<std::byte> const& file(std::vector<NamedFile> const& files, std::string const& name) {
  return std::find_if(files.begin(), files.end(), [&](NamedFile const& f) { return f.name == name; })->bytes;
}

std::string page(std::vector<NamedFile> const& files) {
  std::vector<std::byte> const& bytes = file(files, "index.html");
  return {reinterpret_cast<char const*>(bytes.data()), bytes.size()};
}

template <class Integer>
std::vector<Integer> numbers(std::vector<std::byte> const& bytes) {
  std::vector<Integer> all(bytes.size() / sizeof(Integer));
  std::memcpy(all.data(), bytes.data(), all.size() * sizeof(Integer));
  return all;
}

/// What X3DOM makes of the buffers, in the order of their vertices.
VertexMesh drawn(std::vector<NamedFile> const& files, Grid const& grid) {
  VertexMesh mesh;
  auto const coord = numbers<std::uint16_t>(file(files, "coord.bin"));
  for (std::size_t i = 0; i < coord.size(); i += 3)
    mesh.positions.push_back(grid.origin + V3f(coord[i], coord[i + 1], coord[i + 2]) * (grid.range / 65535));
  auto const texcoord = numbers<std::uint16_t>(file(files, "texcoord.bin"));
  for (std::size_t i = 0; i < texcoord.size(); i += 2)
    mesh.uvs.push_back(V2f(float(texcoord[i]), float(65535 - texcoord[i + 1])) / 65535.f);
  return mesh;
}

TEST(WriteX3d, APageItsBuffersAndItsMaps) {
  EXPECT_THAT(
      names(write_x3d(with_maps(), "Lucy", paper())),
      ElementsAre("index.html", "index.bin", "coord.bin", "normal.bin", "texcoord.bin", "colour.jpg", "normal.png"));
  EXPECT_THAT(names(write_x3d(test::random_model(1), "Lucy", paper())), Not(testing::Contains("colour.jpg")));
}

TEST(WriteX3d, SixteenBitsAreWithinHalfAStep) {
  BakedModel const model = with_maps();
  VertexMesh const shown = drawn(write_x3d(model, "", paper()), model.grid);
  BakedModel bare = model;
  bare.chart_tangents.clear();
  VertexMesh const wanted = split_vertices(bare);
  ASSERT_EQ(shown.positions.size(), wanted.positions.size());
  float const half_step = 0.5f / 65535;
  for (std::size_t v = 0; v < wanted.positions.size(); ++v) {
    for (unsigned k = 0; k < 3; ++k)
      EXPECT_NEAR(shown.positions[v][k], wanted.positions[v][k], 1.01f * half_step * model.grid.range);
    for (unsigned k = 0; k < 2; ++k) EXPECT_NEAR(shown.uvs[v][k], wanted.uvs[v][k], 1.01f * half_step);
  }
}

TEST(WriteX3d, PositionsOnA16BitGridAreExact) {
  BakedModel model = with_maps();
  model.grid.position_bits = 16;
  std::uint32_t i = 7;
  for (V3f& p : model.mesh.positions)
    for (unsigned k = 0; k < 3; ++k)
      p[k] = model.grid.origin[k] + float((i = i * 48271 % 65536)) * (model.grid.range / 65535);
  auto const files = write_x3d(model, "", paper());
  auto const stored = numbers<std::uint16_t>(file(files, "coord.bin"));
  VertexMesh const wanted = split_vertices(model);
  for (std::size_t v = 0; v < std::min(wanted.positions.size(), stored.size() / 3); ++v)
    for (unsigned k = 0; k < 3; ++k) {
      float const step = (wanted.positions[v][k] - model.grid.origin[k]) / (model.grid.range / 65535);
      EXPECT_NEAR(stored[3 * v + k], step, 0.02);
    }
}

TEST(WriteX3d, IndicesHave16BitsWhileTheySuffice) {
  auto const index_type = [](BakedModel const& model) {
    std::string const html = page(write_x3d(model, "", paper()));
    return html.substr(html.find("indexType=\"") + 11, 6);
  };
  BakedModel model;
  model.mesh = test::grid(200, 200);
  model.normals.assign(model.mesh.positions.size(), {0, 1, 0});
  model.grid = {{0, 0, 0}, 300, 16, 16, 8};
  EXPECT_EQ(index_type(model), "Uint16");
  model.mesh = test::grid(300, 300);
  model.normals.assign(model.mesh.positions.size(), {0, 1, 0});
  EXPECT_EQ(index_type(model), "Uint32");
}

TEST(WriteX3d, WithoutNormalsEveryFaceHasItsOwn) {
  BakedModel model;
  model.mesh = test::cube();
  model.grid = {{-1, -1, -1}, 2, 16, 16, 8};
  auto const files = write_x3d(model, "", paper());
  EXPECT_EQ(file(files, "normal.bin").size(), 3u * 36);
  EXPECT_EQ(file(files, "coord.bin").size(), 6u * 36);
}

TEST(WriteX3d, ColoursPerVertexAreLinearAndHoldTheFactor) {
  BakedModel model;
  model.mesh = test::cube();
  model.grid = {{-1, -1, -1}, 2, 16, 16, 8};
  model.normals.assign(8, {0, 1, 0});
  model.colours.assign(8, {1, 0.5f, 0});
  model.base_colour = {0.5f, 0.5f, 1, 1};
  auto const files = write_x3d(model, "", paper());
  auto const colours = numbers<std::uint16_t>(file(files, "colour.bin"));
  EXPECT_EQ(colours.size(), 24u);
  EXPECT_THAT(std::vector(colours.begin(), colours.begin() + 3), ElementsAre(32768, 16384, 0));
}

TEST(WriteX3d, ATitleIsText) {
  EXPECT_THAT(page(write_x3d(with_maps(), "<script>&", paper())), HasSubstr("<title>&lt;script&gt;&amp;</title>"));
}

TEST(WriteX3d, OnlyWhereAsked) {
  EXPECT_TRUE(encode(with_maps(), "").x3d.empty());
  EncodedThumbnail const thumbnail = encode(with_maps(), "", paper());
  EXPECT_FALSE(thumbnail.x3d.empty());
  EXPECT_EQ(thumbnail.x3d_zip, zip(thumbnail.x3d));
}

// ---- The zip

TEST(Zip, HoldsTheFilesInTheirOrder) {
  std::vector<NamedFile> const files = write_x3d(with_maps(), "Lucy", paper());
  std::vector<std::byte> const bytes = zip(files);
  zip_error_t error;
  zip_source_t* const source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
  std::unique_ptr<zip_t, decltype(&zip_discard)> const archive(
      zip_open_from_source(source, ZIP_RDONLY | ZIP_CHECKCONS, &error), zip_discard);
  ASSERT_TRUE(archive);
  ASSERT_EQ(zip_get_num_entries(archive.get(), 0), std::int64_t(files.size()));
  for (std::size_t i = 0; i < files.size(); ++i) {
    EXPECT_EQ(zip_get_name(archive.get(), i, 0), files[i].name);
    zip_file_t* const entry = zip_fopen_index(archive.get(), i, 0);
    std::vector<std::byte> content(files[i].bytes.size() + 1);
    EXPECT_EQ(zip_fread(entry, content.data(), content.size()), std::int64_t(files[i].bytes.size()));
    EXPECT_EQ(zip_fclose(entry), 0);  // checks the sum
    EXPECT_TRUE(std::equal(files[i].bytes.begin(), files[i].bytes.end(), content.begin()));
  }
}

TEST(Zip, TheSameBytesInAnyTimeZone) {
  std::vector<NamedFile> const files = write_x3d(with_maps(), "Lucy", paper());
  std::vector<std::byte> const here = zip(files);
  setenv("TZ", "Pacific/Kiritimati", 1);
  tzset();
  EXPECT_EQ(zip(files), here);
  unsetenv("TZ");
}

TEST(Zip, OthersCanReadIt) {
  if (std::system("command -v unzip >/dev/null") != 0) GTEST_SKIP() << "unzip is not installed";
  test::TemporaryFolder const folder;
  std::vector<std::byte> const bytes = zip(write_x3d(with_maps(), "Lucy", paper()));
  test::write_file(folder.path() / "a.zip", {reinterpret_cast<char const*>(bytes.data()), bytes.size()});
  EXPECT_EQ(std::system(("unzip -tqq '" + (folder.path() / "a.zip").string() + "'").c_str()), 0);
}

}  // namespace
}  // namespace vitrine::io
