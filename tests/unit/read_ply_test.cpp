// SPDX-License-Identifier: Apache-2.0
#include "io/image_codec.h"
#include "io/read_model.h"
#include "tests/support/bytes.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <string>

namespace vitrine {
namespace {

using test::blob;
using test::Bytes;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr std::uint16_t kHalfGrey = 14146;  ///< sRGB byte 128: ((128/255 + 0.055) / 1.055)^2.4 x 65535

std::string const kTriangle = "0 0 0\n1 0 0\n0 1 0\n";

SourceModel read(io::Blob const& file, io::Resolve const& resolve = test::no_files) {
  return io::read_ply(file, resolve);
}
SourceModel read(std::string const& text) { return read(blob(text)); }
std::string refusal(io::Blob const& file) {
  return test::refusal([&] { return read(file); });
}
std::string refusal(std::string const& text) { return refusal(blob(text)); }

/// An ascii file of three vertices with these further properties, and faces.
std::string ascii(std::string const& vertex_properties, std::string const& rows, std::string const& face = "3 0 1 2",
                  std::string const& face_properties = "", std::string const& comment = "") {
  return "ply\nformat ascii 1.0\n" + comment +
         "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n" + vertex_properties +
         "element face 1\nproperty list uchar int vertex_indices\n" + face_properties + "end_header\n" + rows + face +
         "\n";
}

std::string format_of(std::endian order) {
  return order == std::endian::little ? "format binary_little_endian 1.0\n" : "format binary_big_endian 1.0\n";
}

/// Four vertices of a unit square as floats.
Bytes square(std::endian order, std::string const& faces) {
  Bytes file(order);
  file.text("ply\n" + format_of(order) + "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n" +
            faces + "end_header\n");
  file.put(0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 1.0f, 1.0f, 0.0f, 0.0f, 1.0f, 0.0f);
  return file;
}

std::string const kIndexList = "property list uchar int vertex_indices\n";
std::uint8_t const kThree = 3, kFour = 4;

TEST(ReadPly, AsciiTriangle) {
  SourceModel const model = read(ascii("", kTriangle));
  EXPECT_THAT(model.mesh.positions, ElementsAre(V3f(0, 0, 0), V3f(1, 0, 0), V3f(0, 1, 0)));
  EXPECT_THAT(model.mesh.triangles, ElementsAre(Triangle{0, 1, 2}));
  EXPECT_THAT(model.colours, IsEmpty());
  EXPECT_THAT(model.notes, IsEmpty());
}

TEST(ReadPly, LinesMayEndAsOnWindows) {
  std::string text = ascii("", kTriangle);
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.replace(at, 1, "\r\n");
  EXPECT_THAT(read(text).mesh.triangles, SizeIs(1));
}

/// As Rhinoceros writes them; what follows the header is numbers, whichever bytes they have.
TEST(ReadPly, LinesOfTheHeaderMayEndAsOnMacintoshs) {
  std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
  std::ranges::replace(header, '\n', '\r');
  float const first = std::bit_cast<float>(0x0A0A0A0Au);
  Bytes file = Bytes().text(header).put(first, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f).put(kThree).put(0, 1, 2);
  SourceModel const model = read(file.blob());
  EXPECT_EQ(model.mesh.positions[0].x, first);
  EXPECT_THAT(model.mesh.triangles, ElementsAre(Triangle{0, 1, 2}));
}

class ReadPlyInBothOrders : public testing::TestWithParam<std::endian> {};
INSTANTIATE_TEST_SUITE_P(Orders, ReadPlyInBothOrders, testing::Values(std::endian::little, std::endian::big));

TEST_P(ReadPlyInBothOrders, TrianglesOfInts) {
  Bytes file = square(GetParam(), "element face 2\n" + kIndexList);
  file.put(kThree, 0, 1, 2, kThree, 0, 2, 3);
  SourceModel const model = read(file.blob());
  EXPECT_EQ(model.mesh.positions[2], V3f(1, 1, 0));
  EXPECT_THAT(model.mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
}

TEST_P(ReadPlyInBothOrders, TrianglesOfUnsignedInts) {
  Bytes file = square(GetParam(), "element face 1\nproperty list uchar uint vertex_index\n");
  file.put(kThree, 1u, 2u, 3u);
  EXPECT_THAT(read(file.blob()).mesh.triangles, ElementsAre(Triangle{1, 2, 3}));
}

TEST_P(ReadPlyInBothOrders, ListsOfOtherTypes) {
  Bytes file = square(GetParam(), "element face 1\nproperty list int ushort vertex_indices\n");
  file.put(4, std::uint16_t{0}, std::uint16_t{1}, std::uint16_t{2}, std::uint16_t{3});
  EXPECT_THAT(read(file.blob()).mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
}

TEST_P(ReadPlyInBothOrders, PolygonsOfDifferentSizes) {
  Bytes file = square(GetParam(), "element face 3\n" + kIndexList);
  file.put(kThree, 0, 1, 2, std::uint8_t{2}, 0, 1, kFour, 0, 1, 2, 3);
  EXPECT_THAT(read(file.blob()).mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 1, 2}, Triangle{0, 2, 3}));
}

TEST_P(ReadPlyInBothOrders, UnknownElementsAndPropertiesArePassedOver) {
  Bytes file(GetParam());
  file.text("ply\n" + format_of(GetParam()) +
            "element camera 1\nproperty double focal\nproperty list uchar short marks\n"
            "element vertex 3\nproperty short flags\nproperty float x\nproperty float y\nproperty float z\nproperty "
            "double quality\n"
            "element face 1\nproperty int flags\n" +
            kIndexList + "property float quality\nend_header\n");
  file.put(35.0, std::uint8_t{2}, std::int16_t{7}, std::int16_t{8});
  for (float x : {0.0f, 1.0f, 2.0f}) file.put(std::int16_t{9}, x, 2 * x, 3 * x, 0.5);
  file.put(1, kThree, 2, 1, 0, 0.25f);
  SourceModel const model = read(file.blob());
  EXPECT_EQ(model.mesh.positions[2], V3f(2, 4, 6));
  EXPECT_THAT(model.mesh.triangles, ElementsAre(Triangle{2, 1, 0}));
  EXPECT_THAT(model.notes, ElementsAre(HasSubstr("\"camera\" ignored")));
}

TEST_P(ReadPlyInBothOrders, FacesMayStandBeforeTheVertices) {
  Bytes file(GetParam());
  file.text("ply\n" + format_of(GetParam()) + "element face 1\n" + kIndexList +
            "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nend_header\n");
  file.put(kThree, 0, 1, 2, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f);
  EXPECT_THAT(read(file.blob()).mesh.triangles, ElementsAre(Triangle{0, 1, 2}));
}

TEST_P(ReadPlyInBothOrders, StripsTurnEveryOtherTriangleAndBeginAnew) {
  Bytes file = square(GetParam(), "element tristrips 1\nproperty list int int vertex_indices\n");
  file.put(8, 0, 1, 2, 3, -1, 3, 2, 1);
  EXPECT_THAT(read(file.blob()).mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{2, 1, 3}, Triangle{3, 2, 1}));
}

TEST_P(ReadPlyInBothOrders, VerticesWithListsAreReadToo) {
  Bytes file(GetParam());
  file.text("ply\n" + format_of(GetParam()) +
            "element vertex 3\nproperty float x\nproperty list uchar int marks\nproperty float y\nproperty float "
            "z\nelement face 1\n" +
            kIndexList + "end_header\n");
  file.put(0.0f, std::uint8_t{0}, 0.0f, 0.0f, 1.0f, std::uint8_t{2}, 5, 6, 0.0f, 0.0f, 0.0f, std::uint8_t{1}, 5, 1.0f,
           0.0f);
  file.put(kThree, 0, 1, 2);
  EXPECT_THAT(read(file.blob()).mesh.positions, ElementsAre(V3f(0, 0, 0), V3f(1, 0, 0), V3f(0, 1, 0)));
}

TEST(ReadPly, ByteColoursAreSrgb) {
  SourceModel const model = read(ascii("property uchar red\nproperty uchar green\nproperty uchar blue\n",
                                       "0 0 0 0 128 255\n1 0 0 0 0 0\n0 1 0 0 0 0\n"));
  EXPECT_EQ(model.colours[0], (Rgba16{0, kHalfGrey, 65535, 65535}));
}

TEST(ReadPly, ColoursOfOtherTypesSpanTheirRange) {
  std::string const rows = "0 0 0 0 0.50196078 9\n1 0 0 0 0 0\n0 1 0 0 0 0\n";
  SourceModel const floats = read(ascii("property float red\nproperty float green\nproperty float blue\n", rows));
  EXPECT_EQ(floats.colours[0], (Rgba16{0, kHalfGrey, 65535, 65535}));
  std::string const wide = "0 0 0 0 32896 65535\n1 0 0 0 0 0\n0 1 0 0 0 0\n";
  SourceModel const shorts = read(ascii("property ushort red\nproperty ushort green\nproperty ushort blue\n", wide));
  EXPECT_EQ(shorts.colours[0], floats.colours[0]);
}

TEST(ReadPly, DiffuseColoursCountAndAlphaDoesNot) {
  SourceModel const model = read(ascii(
      "property uchar diffuse_red\nproperty uchar diffuse_green\nproperty uchar diffuse_blue\nproperty uchar alpha\n",
      "0 0 0 255 0 0 7\n1 0 0 0 0 0 7\n0 1 0 0 0 0 7\n"));
  EXPECT_EQ(model.colours[0], (Rgba16{65535, 0, 0, 65535}));
}

TEST(ReadPly, NormalsAreMadeUnit) {
  SourceModel const model = read(
      ascii("property float nx\nproperty float ny\nproperty float nz\n", "0 0 0 0 0 2\n1 0 0 0 0 2\n0 1 0 0 0 2\n"));
  EXPECT_THAT(model.normals, Each(V3f(0, 0, 1)));
}

TEST(ReadPly, NormalsThatAreAllZeroAreLeftOut) {
  SourceModel const model = read(
      ascii("property float nx\nproperty float ny\nproperty float nz\n", "0 0 0 0 0 0\n1 0 0 0 0 0\n0 1 0 0 0 0\n"));
  EXPECT_THAT(model.normals, IsEmpty());
  EXPECT_THAT(model.notes, ElementsAre(HasSubstr("all zero")));
}

TEST(ReadPly, TextureCoordinatesPointDown) {
  for (std::string const names : {"s t", "u v", "texture_u texture_v"}) {
    std::string const u = names.substr(0, names.find(' ')), v = names.substr(names.find(' ') + 1);
    SourceModel const model =
        read(ascii("property float " + u + "\nproperty float " + v + "\n", "0 0 0 0.25 0.75\n1 0 0 0 0\n0 1 0 0 1\n"));
    EXPECT_THAT(model.uvs, ElementsAre(V2f(0.25f, 0.25f), V2f(0, 1), V2f(0, 0))) << names;
  }
}

/// Two faces of a square with colours of their own.
TEST(ReadPly, FaceColoursSplitVertices) {
  Bytes file = square(std::endian::little, "element face 2\n" + kIndexList +
                                               "property uchar red\nproperty uchar green\nproperty uchar blue\n");
  std::uint8_t const full = 255, none = 0;
  file.put(kThree, 0, 1, 2, full, none, none, kThree, 0, 2, 3, none, full, none);
  SourceModel const model = read(file.blob());
  EXPECT_THAT(model.mesh.positions, SizeIs(6));
  EXPECT_THAT(model.mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{3, 4, 5}));
  EXPECT_EQ(model.colours[2], (Rgba16{65535, 0, 0, 65535}));
  EXPECT_EQ(model.colours[3], (Rgba16{0, 65535, 0, 65535}));
}

TEST(ReadPly, FacesOfOneColourShareVertices) {
  Bytes file = square(std::endian::little, "element face 2\n" + kIndexList +
                                               "property uchar red\nproperty uchar green\nproperty uchar blue\n");
  std::uint8_t const full = 255;
  file.put(kThree, 0, 1, 2, full, full, full, kThree, 0, 2, 3, full, full, full);
  EXPECT_THAT(read(file.blob()).mesh.positions, SizeIs(4));
}

TEST(ReadPly, VertexColoursWinOverFaceColours) {
  std::string const rgb = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  SourceModel const model = read(ascii(rgb, "0 0 0 255 0 0\n1 0 0 255 0 0\n0 1 0 255 0 0\n", "3 0 1 2 0 0 255", rgb));
  EXPECT_THAT(model.colours, Each(Rgba16{65535, 0, 0, 65535}));
}

/// A 1 x 1 red PNG under every name.
std::optional<io::Blob> red_texture(std::string_view) {
  Image const image{1, 1, 3, ColourSpace::srgb, {255, 0, 0}};
  return io::own(io::encode_image(image, {.codec = io::ImageCodec::png}).bytes);
}

std::string const kTextureFile = "comment TextureFile paint one.png\n";
std::string const kCornerUvs = "property list uchar float texcoord\n";

TEST(ReadPly, ATextureFileBecomesAMaterial) {
  SourceModel const model = read(blob(ascii("property float s\nproperty float t\n", "0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n",
                                            "3 0 1 2", "", kTextureFile)),
                                 red_texture);
  ASSERT_THAT(model.materials, SizeIs(1));
  EXPECT_EQ(model.materials[0].name, "paint one.png");
  EXPECT_EQ(model.materials[0].colour_map.image, 0);
  EXPECT_THAT(model.images.at(0).texels, ElementsAre(255, 0, 0));
  EXPECT_TRUE(has_colour(model));
}

TEST(ReadPly, AMissingTextureCostsNothingElse) {
  SourceModel const model = read(
      ascii("property float s\nproperty float t\n", "0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n", "3 0 1 2", "", kTextureFile));
  EXPECT_THAT(model.mesh.triangles, SizeIs(1));
  EXPECT_FALSE(has_colour(model));
  EXPECT_THAT(model.notes, ElementsAre(HasSubstr("paint one.png")));
}

TEST(ReadPly, ADamagedTextureCostsNothingElse) {
  std::string const text =
      ascii("property float s\nproperty float t\n", "0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n", "3 0 1 2", "", kTextureFile);
  SourceModel const model = read(blob(text), [](std::string_view) { return blob("no image"); });
  EXPECT_FALSE(has_colour(model));
  EXPECT_THAT(model.notes, ElementsAre(HasSubstr("paint one.png")));
}

TEST(ReadPly, CornerTextureCoordinatesSplitVerticesOnceForEach) {
  Bytes file(std::endian::big);
  file.text("ply\n" + format_of(std::endian::big) + kTextureFile +
            "element vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 2\n" + kIndexList +
            kCornerUvs + "end_header\n");
  file.put(0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 1.0f, 1.0f, 0.0f, 0.0f, 1.0f, 0.0f);
  std::uint8_t const six = 6;
  file.put(kThree, 0, 1, 2, six, 0.0f, 0.0f, 1.0f, 0.0f, 1.0f, 1.0f);
  file.put(kThree, 0, 2, 3, six, 0.5f, 0.0f, 1.0f, 1.0f, 0.0f, 1.0f);  // another uv at vertex 0, the same at vertex 2
  SourceModel const model = read(file.blob(), red_texture);
  EXPECT_THAT(model.mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{3, 2, 4}));
  EXPECT_THAT(model.uvs, ElementsAre(V2f(0, 1), V2f(1, 1), V2f(1, 0), V2f(0.5f, 1), V2f(0, 0)));
  EXPECT_EQ(model.mesh.positions[3], V3f(0, 0, 0));
}

TEST(ReadPly, CornerTextureCoordinatesWithoutATextureAreLeftOut) {
  SourceModel const model = read(ascii("", kTriangle, "3 0 1 2 6 0 0 1 0 0 1", kCornerUvs));
  EXPECT_THAT(model.uvs, IsEmpty());
}

TEST(ReadPly, TextureNumbersChooseMaterials) {
  std::string const text = "ply\nformat ascii 1.0\n" + kTextureFile + "comment TextureFile two.png\n" +
                           "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 3\n" +
                           kIndexList + kCornerUvs + "property int texnumber\nend_header\n" + kTriangle +
                           "3 0 1 2 6 0 0 1 0 0 1 1\n3 0 1 2 6 0 0 1 0 0 1 0\n3 0 1 2 6 0 0 1 0 0 1 -1\n";
  SourceModel const model = read(blob(text), red_texture);
  EXPECT_THAT(model.materials, SizeIs(3));
  EXPECT_THAT(model.face_materials, ElementsAre(1, 0, 2));
  EXPECT_THAT(model.notes, ElementsAre(HasSubstr("1 triangles name none")));
}

TEST(ReadPly, FarAndSmallModelsGetAnOrigin) {
  std::string text = ascii("", "500000.125 0 0\n500001.125 0 0\n500000.125 1 0\n");
  SourceModel const model = read(text);
  EXPECT_EQ(model.origin, V3d(500000.625, 0.5, 0));
  EXPECT_THAT(model.mesh.positions, ElementsAre(V3f(-0.5f, -0.5f, 0), V3f(0.5f, -0.5f, 0), V3f(-0.5f, 0.5f, 0)));
}

TEST(ReadPly, NearModelsStayWhereTheyAre) {
  SourceModel const model = read(ascii("", "5 0 0\n6 0 0\n5 1 0\n"));
  EXPECT_EQ(model.origin, V3d(0, 0, 0));
}

TEST(ReadPly, PositionsThatAreNotFiniteAreLeftToCleaning) {
  SourceModel const model = read(ascii("", "nan 0 0\n1 0 0\n0 1 -inf\n"));
  EXPECT_TRUE(std::isnan(model.mesh.positions[0].x));
  EXPECT_TRUE(std::isinf(model.mesh.positions[2].z));
}

TEST(ReadPlyRefuses, IndicesOutOfRange) {
  EXPECT_THAT(refusal(ascii("", kTriangle, "3 0 1 3")), HasSubstr("face 0 names vertex 3 of 3"));
  EXPECT_THAT(refusal(ascii("", kTriangle, "3 0 -1 2")), HasSubstr("face 0 names vertex -1 of 3"));
  Bytes file = square(std::endian::little, "element face 2\n" + kIndexList);
  EXPECT_THAT(refusal(file.put(kThree, 0, 1, 2, kThree, 0, 77, 3).blob()), HasSubstr("face 1 names vertex 77 of 4"));
}

TEST(ReadPlyRefuses, StripsOutOfRange) {
  Bytes file = square(std::endian::little, "element tristrips 1\nproperty list int int vertex_indices\n");
  EXPECT_THAT(refusal(file.put(3, 0, 1, 9).blob()), HasSubstr("vertex 9 of 4"));
}

TEST(ReadPlyRefuses, CutFaces) {
  Bytes file = square(std::endian::little, "element face 2\n" + kIndexList);
  file.put(kThree, 0, 1, 2, kThree, 0, 2, 3).cut(1);
  EXPECT_THAT(refusal(file.blob()), HasSubstr("\"face\": the file ends within record 1 of 2"));
}

TEST(ReadPlyRefuses, CutText) {
  EXPECT_THAT(refusal(ascii("", kTriangle, "3 0 1")), HasSubstr("line 13: a number is missing"));
}

TEST(ReadPlyRefuses, WordsInPlaceOfNumbers) {
  EXPECT_THAT(refusal(ascii("", "0 0 zero\n1 0 0\n0 1 0\n")), HasSubstr("line 10: \"zero\" is no number"));
}

TEST(ReadPlyRefuses, ColoursThatAreNoNumbers) {
  EXPECT_THAT(refusal(ascii("property float red\nproperty float green\nproperty float blue\n",
                            "0 0 0 0 0 0\n1 0 0 0 nan 0\n0 1 0 0 0 0\n")),
              HasSubstr("vertex 1 has a colour"));
}

TEST(ReadPlyRefuses, PointClouds) {
  EXPECT_THAT(refusal("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float "
                      "z\nend_header\n0 0 0\n"),
              HasSubstr("1 points alone"));
}

TEST(ReadPlyRefuses, TextConversionsAndSaysSo) {
  Bytes file = square(std::endian::little, "element face 2\n" + kIndexList);
  for (int i = 0; i < 20; ++i) file.text("\xEF\xBF\xBD");
  EXPECT_THAT(refusal(file.blob()), HasSubstr("converted as if it were text"));
}

TEST(ReadPlyRefuses, HeadersThatMakeNoSense) {
  EXPECT_THAT(refusal(""), HasSubstr("does not begin with \"ply\""));
  EXPECT_THAT(refusal("ply\nformat ascii 1.0\n"), HasSubstr("header has no end"));
  EXPECT_THAT(refusal("ply\nformat ebcdic 1.0\n"), HasSubstr("line 2: \"ebcdic\" is no PLY format"));
  EXPECT_THAT(refusal("ply\nproperty float x\n"), HasSubstr("line 2: a property stands before any element"));
  EXPECT_THAT(refusal("ply\nelement vertex -1\n"), HasSubstr("-1 elements"));
  EXPECT_THAT(refusal("ply\nelement vertex 1\nproperty quad x\n"), HasSubstr("line 3: \"quad\" is no PLY type"));
  EXPECT_THAT(refusal("ply\nelement vertex 1\nelement vertex 1\n"), HasSubstr("announced twice"));
  EXPECT_THAT(refusal("ply\nformat ascii 1.0\nend_header\n"), HasSubstr("no element vertex"));
}

TEST(ReadPlyRefuses, MoreThanTheLimits) {
  io::ReadOptions options;
  options.limits.vertices = 2;
  EXPECT_THAT(test::refusal([&] { return io::read_ply(blob(ascii("", kTriangle)), test::no_files, options); }),
              HasSubstr("3 vertices exceed the limit of 2"));
}

}  // namespace
}  // namespace vitrine
