// SPDX-License-Identifier: Apache-2.0
#include "io/read_model.h"
#include "tests/support/bytes.h"

#include <gmock/gmock.h>

#include <string>

namespace vitrine {
namespace {

using testing::HasSubstr;

std::string const kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

std::string refusal(std::string_view ending, std::string const& file, io::Resolve const& resolve = test::no_files) {
  return test::refusal([&] { return io::read_model(ending, test::blob(file), resolve); });
}

TEST(StandIn, IsNamedInAnyFormat) {
  for (io::Format const& format : io::formats()) {
    EXPECT_THAT(refusal(format.ending, "version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 9\n"),
                HasSubstr("the file is a Git-LFS pointer"))
        << format.ending;
    EXPECT_THAT(refusal(format.ending, "\r\n <!DOCTYPE HTML><html><p>404</p></html>"), HasSubstr("a web page"))
        << format.ending;
    for (std::string const mark : {"\xFF\xFE", "\xFE\xFF"}) {
      std::string text = mark;
      for (char c : std::string("v 0 0 0")) text += mark == "\xFF\xFE" ? std::string{c, '\0'} : std::string{'\0', c};
      EXPECT_THAT(refusal(format.ending, text), HasSubstr("UTF-16")) << format.ending;
    }
  }
}

TEST(StandIn, IsNamedWhereGeometryLies) {
  std::string const gltf = R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"uri": "a.bin", "byteLength": 36}]})";
  auto const page = [](std::string_view) { return std::optional(test::blob("<html>not found</html>")); };
  EXPECT_THAT(refusal(".gltf", gltf, page), HasSubstr("the file \"a.bin\" is a web page"));
}

TEST(StandIn, BinaryFilesMayBeginWithAMark) {
  test::Bytes stl;
  stl.text("\xFF\xFE").text(std::string(78, 'h')).put(std::uint32_t{1});
  for (float value : {0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) stl.put(value);
  stl.put(std::uint16_t{0});
  EXPECT_EQ(io::read_model(".stl", stl.blob(), test::no_files).mesh.triangles.size(), 1u);
}

TEST(Text, IsReadWithoutItsMark) {
  SourceModel const model = io::read_model(".obj", test::blob("\xEF\xBB\xBF" + kTriangle), test::no_files);
  EXPECT_EQ(model.mesh.positions.size(), 3u);
  auto const library = [](std::string_view) { return std::optional(test::blob("\xEF\xBB\xBFnewmtl m\nKd 1 0 0\n")); };
  SourceModel const red = io::read_model(".obj", test::blob("mtllib a.mtl\nusemtl m\n" + kTriangle), library);
  EXPECT_TRUE(red.materials[0].coloured);
}

}  // namespace
}  // namespace vitrine
