// SPDX-License-Identifier: Apache-2.0
#include "io/read_model.h"
#include "tests/support/bytes.h"

#include <gmock/gmock.h>

#include <string>

namespace vitrine {
namespace {

using test::blob;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr std::uint16_t kHalfGrey = 14146;  ///< linear value of sRGB 128 of 255
constexpr Rgba16 kRed{65535, 0, 0, 65535}, kWhite{65535, 65535, 65535, 65535};

SourceModel read(std::string const& text) { return io::read_off(blob(text), test::no_files); }
std::string refusal(std::string const& text) {
  return test::refusal([&] { return read(text); });
}

std::string const kVertices = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

TEST(ReadOff, PolygonsBecomeFans) {
  SourceModel const model = read("OFF\n4 1 0\n" + kVertices + "4 0 1 2 3\n");
  EXPECT_THAT(model.mesh.positions, ElementsAre(V3f(0, 0, 0), V3f(1, 0, 0), V3f(1, 1, 0), V3f(0, 1, 0)));
  EXPECT_THAT(model.mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
  EXPECT_FALSE(has_colour(model));
}

TEST(ReadOff, CountsMayStandInTheHeading) {
  EXPECT_THAT(read("OFF 4 1 0\n" + kVertices + "3 0 1 2\n").mesh.triangles, SizeIs(1));
  EXPECT_THAT(read("OFF4 1 0\n" + kVertices + "3 0 1 2\n").mesh.triangles, SizeIs(1));
}

TEST(ReadOff, CommentsAndEmptyLinesMayStandAnywhere) {
  std::string const text = "# a scan\nOFF # plain\n\n4 1 0\n0 0 0\n#\n1 0 0 # second\n1 1 0\n0 1 0\n\n3 0 1 2 # face\n";
  EXPECT_THAT(read(text).mesh.triangles, ElementsAre(Triangle{0, 1, 2}));
}

TEST(ReadOff, LinesAndPointsAreNoTriangles) {
  EXPECT_THAT(read("OFF 4 3 0\n" + kVertices + "1 0\n2 0 1\n3 1 2 3\n").mesh.triangles, ElementsAre(Triangle{1, 2, 3}));
}

TEST(ReadOff, VertexColoursAsBytes) {
  SourceModel const model = read("COFF 3 1 0\n0 0 0 0 128 255 255\n1 0 0 255 0 0 255\n0 1 0 255 0 0\n3 0 1 2\n");
  EXPECT_THAT(model.colours, ElementsAre(Rgba16{0, kHalfGrey, 65535, 65535}, kRed, kRed));
}

TEST(ReadOff, VertexColoursAsFractions) {
  SourceModel const model =
      read("COFF 3 1 0\n0 0 0 0.0 0.50196078 1.0 1.0\n1 0 0 1.0 0.0 0.0 1.0\n0 1 0 1.0 0.0 0.0 1.0\n3 0 1 2\n");
  EXPECT_EQ(model.colours[0], (Rgba16{0, kHalfGrey, 65535, 65535}));
}

TEST(ReadOff, VertexColoursUnderAPlainHeading) {
  EXPECT_THAT(read("OFF 3 1 0\n0 0 0 255 0 0\n1 0 0 255 0 0\n0 1 0 255 0 0\n3 0 1 2\n").colours, Each(kRed));
}

TEST(ReadOff, NormalsAreMadeUnit) {
  EXPECT_THAT(read("NOFF 3 1 0\n0 0 0 0 0 5\n1 0 0 0 0 5\n0 1 0 0 0 5\n3 0 1 2\n").normals, Each(V3f(0, 0, 1)));
}

TEST(ReadOff, EverythingAtOnceInTheOrderOfTheHeading) {
  SourceModel const model = read(
      "STCNOFF 3 1 0\n0 0 0 0 0 5 255 0 0 255 0.25 0.75\n1 0 0 0 0 5 255 0 0 255 0 0\n0 1 0 0 0 5 255 0 0 255 0 1\n3 0 "
      "1 2\n");
  EXPECT_THAT(model.normals, Each(V3f(0, 0, 1)));
  EXPECT_THAT(model.colours, Each(kRed));
  EXPECT_THAT(model.uvs, ElementsAre(V2f(0.25f, 0.25f), V2f(0, 1), V2f(0, 0)));
}

TEST(ReadOff, FaceColoursSplitVertices) {
  SourceModel const model = read("OFF 4 2 0\n" + kVertices + "3 0 1 2 255 0 0\n3 0 2 3 1.0 1.0 1.0\n");
  EXPECT_THAT(model.mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{3, 4, 5}));
  EXPECT_THAT(model.colours, ElementsAre(kRed, kRed, kRed, kWhite, kWhite, kWhite));
}

TEST(ReadOff, FacesWithoutColourAreWhiteBesideColouredOnes) {
  SourceModel const model = read("OFF 4 3 0\n" + kVertices + "3 0 1 2\n3 0 2 3 255 0 0\n3 1 2 3\n");
  EXPECT_EQ(model.colours[0], kWhite);
  EXPECT_EQ(model.colours[model.mesh.triangles[1][0]], kRed);
  EXPECT_EQ(model.colours[model.mesh.triangles[2][0]], kWhite);
}

TEST(ReadOff, ColourMapIndicesAreNoColours) {
  EXPECT_THAT(read("OFF 4 1 0\n" + kVertices + "3 0 1 2 7\n").colours, IsEmpty());
}

TEST(ReadOff, FarAndSmallModelsGetAnOrigin) {
  SourceModel const model = read("OFF 3 1 0\n4000000.25 0 0\n4000001.25 0 0\n4000000.25 1 0\n3 0 1 2\n");
  EXPECT_EQ(model.origin, V3d(4000000.75, 0.5, 0));
  EXPECT_EQ(model.mesh.positions[0], V3f(-0.5f, -0.5f, 0));
}

TEST(ReadOffRefuses, OtherHeadings) {
  EXPECT_THAT(refusal(""), HasSubstr("empty"));
  EXPECT_THAT(refusal("PLY\n"), HasSubstr("line 1: \"PLY\" is no OFF heading"));
  EXPECT_THAT(refusal("OFFICE\n"), HasSubstr("no OFF heading"));
  EXPECT_THAT(refusal("4OFF\n"), HasSubstr("four or more dimensions"));
  EXPECT_THAT(refusal("OFF BINARY\n"), HasSubstr("binary OFF is not read"));
  EXPECT_THAT(refusal("OFF\n7\n"), HasSubstr("line 2: the counts"));
}

TEST(ReadOffRefuses, CutFiles) {
  EXPECT_THAT(refusal("OFF 4 1 0\n0 0 0\n1 0 0\n1 1 0.333333\n"), HasSubstr("ends after 3 of 4 vertices"));
  EXPECT_THAT(refusal("OFF 4 2 0\n" + kVertices + "3 0 1 2\n"), HasSubstr("ends after 1 of 2 faces"));
  EXPECT_THAT(refusal("OFF 4 1 0\n" + kVertices + "3 0 1\n"), HasSubstr("a face of 3 corners has 2 numbers"));
}

TEST(ReadOffRefuses, IndicesOutOfRange) {
  EXPECT_THAT(refusal("OFF 4 1 0\n" + kVertices + "3 0 1 4\n"), HasSubstr("line 6: a face names vertex 4 of 4"));
  EXPECT_THAT(refusal("OFF 4 1 0\n" + kVertices + "3 0 -1 2\n"), HasSubstr("vertex -1 of 4"));
}

TEST(ReadOffRefuses, ColoursThatAreNoNumbers) {
  EXPECT_THAT(refusal("COFF 3 1 0\n0 0 0 nan 0 0 1\n1 0 0 0 0 0 1\n0 1 0 0 0 0 1\n3 0 1 2\n"),
              HasSubstr("line 2: a colour is \"nan\""));
}

TEST(ReadOffRefuses, PointClouds) { EXPECT_THAT(refusal("OFF 1 0 0\n0 0 0\n"), HasSubstr("1 points alone")); }

}  // namespace
}  // namespace vitrine
