// SPDX-License-Identifier: Apache-2.0
#include "io/read_model.h"
#include "tests/support/bytes.h"

#include <gmock/gmock.h>

#include <string>

namespace vitrine {
namespace {

using test::blob;
using test::Bytes;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

SourceModel read(io::Blob const& file) { return io::read_stl(file, test::no_files); }
std::string refusal(io::Blob const& file) {
  return test::refusal([&] { return read(file); });
}

std::string const kFacet =
    "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  vertex 0 1 0\n endloop\nendfacet\n";

Bytes binary(std::uint32_t promised, std::string header = "") {
  header.resize(80, ' ');
  return Bytes().text(header).put(promised);
}

Bytes& facet(Bytes& file, V3f const& a, V3f const& b, V3f const& c) {
  file.put(0.0f, 0.0f, 1.0f);
  for (V3f const& p : {a, b, c}) file.put(p.x, p.y, p.z);
  return file.put(std::uint16_t{0});
}

/// A square of two facets.
Bytes square(std::string const& header = "") {
  Bytes file = binary(2, header);
  facet(file, {1, 0, 0}, {1, 1, 0}, {0, 0, 0});
  return facet(file, {0, 0, 0}, {1, 1, 0}, {0, 1, 0});
}

TEST(ReadStl, WeldsPlacesInTheOrderOfFirstUse) {
  SourceModel const model = read(square().blob());
  EXPECT_THAT(model.mesh.positions, ElementsAre(V3f(1, 0, 0), V3f(1, 1, 0), V3f(0, 0, 0), V3f(0, 1, 0)));
  EXPECT_THAT(model.mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{2, 1, 3}));
}

TEST(ReadStl, GivesNoNormalsAndNoColours) {
  SourceModel const model = read(square().blob());
  EXPECT_THAT(model.normals, IsEmpty());
  EXPECT_FALSE(has_colour(model));
}

TEST(ReadStl, ABinaryHeaderMayBeginWithSolid) {
  EXPECT_THAT(read(square("solid facet").blob()).mesh.triangles, SizeIs(2));
}

TEST(ReadStl, MinusZeroIsThePlaceOfZero) {
  Bytes file = binary(1);
  facet(file, {0.0f, 0, 0}, {-0.0f, 0, 0}, {1, 0, 0});
  EXPECT_THAT(read(file.blob()).mesh.positions, SizeIs(2));
}

TEST(ReadStl, NeighboursAreNotWelded) {
  Bytes file = binary(1);
  facet(file, {1, 0, 0}, {std::nextafter(1.0f, 2.0f), 0, 0}, {0, 1, 0});
  EXPECT_THAT(read(file.blob()).mesh.positions, SizeIs(3));
}

TEST(ReadStl, Ascii) {
  SourceModel const model = read(blob("solid square\n" + kFacet + kFacet + "endsolid square\n"));
  EXPECT_THAT(model.mesh.positions, ElementsAre(V3f(0, 0, 0), V3f(1, 0, 0), V3f(0, 1, 0)));
  EXPECT_THAT(model.mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 1, 2}));
  EXPECT_THAT(model.notes, IsEmpty());
}

TEST(ReadStl, AsciiKeywordsInAnyCaseAndSeveralSolids) {
  std::string text = "SOLID a\n" + kFacet + "ENDSOLID a\nsolid b\n" + kFacet + "endsolid\n";
  text.replace(text.find("vertex"), 6, "VERTEX");
  EXPECT_THAT(read(blob(text)).mesh.triangles, SizeIs(2));
}

TEST(ReadStl, NotesThatEndsolidIsMissing) {
  EXPECT_THAT(read(blob("solid a\n" + kFacet)).notes, ElementsAre(HasSubstr("no endsolid")));
}

TEST(ReadStl, NotesAFewBytesTooMany) {
  EXPECT_THAT(read(square().text("end").blob()).notes, ElementsAre(HasSubstr("3 bytes")));
}

TEST(ReadStlRefuses, CutBinaryFilesWithBothCounts) {
  EXPECT_THAT(refusal(square().cut(1).blob()), HasSubstr("says 2 triangles, the file holds 1"));
}

TEST(ReadStlRefuses, BinaryFilesThatAreTooLong) {
  EXPECT_THAT(refusal(square().text(std::string(50, ' ')).blob()), HasSubstr("says 2 triangles, the file holds 3"));
}

TEST(ReadStlRefuses, AsciiCutWithinAFacet) {
  std::string const text = "solid a\n" + kFacet + kFacet;
  EXPECT_THAT(refusal(blob(text.substr(0, text.rfind("endloop")))), HasSubstr("ends within a facet"));
  EXPECT_THAT(refusal(blob(text.substr(0, text.rfind("vertex") + 8))), HasSubstr("line 13: a number is missing"));
}

TEST(ReadStlRefuses, FacetsOfOtherThanThreeCorners) {
  std::string text = "solid a\n" + kFacet + "endsolid\n";
  text.insert(text.find("endloop"), "vertex 2 2 2\n ");
  EXPECT_THAT(refusal(blob(text)), HasSubstr("line 8: a facet has 4 corners"));
}

TEST(ReadStlRefuses, WordsThatAreNoKeywords) {
  EXPECT_THAT(refusal(blob("solid a\nfacet normal 0 0 1\n<html>\n")),
              HasSubstr("line 3: \"<html>\" is no STL keyword"));
}

TEST(ReadStlRefuses, FilesWithoutTriangles) {
  EXPECT_THAT(refusal(blob("")), HasSubstr("0 bytes"));
  EXPECT_THAT(refusal(blob("solid a\nendsolid a\n")), HasSubstr("no triangles"));
  EXPECT_THAT(refusal(binary(0).blob()), HasSubstr("no triangles"));
}

}  // namespace
}  // namespace vitrine
