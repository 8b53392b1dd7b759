// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "io/image_codec.h"
#include "io/read_model.h"

using namespace vitrine;
using namespace vitrine::io;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

namespace {

Blob blob(std::string_view text) {
  auto const bytes = std::as_bytes(std::span(text));
  std::vector<std::byte> copy(bytes.begin(), bytes.end());
  auto const owner = std::make_shared<std::vector<std::byte> const>(std::move(copy));
  return {*owner, owner};
}

std::string png_of(std::uint8_t red) {
  auto const encoded = encode_image({1, 1, 3, ColourSpace::srgb, {red, 0, 0}}, {ImageCodec::png});
  return {reinterpret_cast<char const*>(encoded.bytes.data()), encoded.bytes.size()};
}

/// Files beside the model, by exact name.
using Folder = std::map<std::string, std::string, std::less<>>;

SourceModel read(std::string_view obj, Folder const& folder = {}, ReadOptions const& options = {}) {
  Resolve const resolve = [&](std::string_view name) -> std::optional<Blob> {
    if (name.find("..") != name.npos) throw Error(ErrorKind::invalid_input, "leads out", "");
    auto const file = folder.find(name);
    return file == folder.end() ? std::nullopt : std::optional(blob(file->second));
  };
  return read_obj(blob(obj), resolve, options);
}

std::string failure(std::string_view obj, ReadOptions const& options = {}) {
  try {
    read(obj, {}, options);
  } catch (Error const& error) {
    return error.what();
  }
  return "no failure";
}

std::string const square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
std::string const mapped_square = square + "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
std::string const mapped_face = "f 1/1 2/2 3/3\n";

TEST(ReadObj, PolygonsBecomeFansAboutTheirFirstCorner) {
  SourceModel const model = read(square + "v -1 0.5 0\nf 1 2 3 4 5\n");
  EXPECT_THAT(model.mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}, Triangle{0, 3, 4}));
}

TEST(ReadObj, NegativeIndicesCountBackFromTheLastVertexSoFar) {
  SourceModel const model = read(square + "f -4 -3 -2\nv 9 9 9\nf -1 1 2\n");
  EXPECT_EQ(model.mesh.positions[0], V3f(0, 0, 0));
  EXPECT_EQ(model.mesh.positions[3], V3f(9, 9, 9));
}

TEST(ReadObj, VerticesAreDistinctTriplesInTheOrderOfFirstUse) {
  SourceModel const model = read(mapped_square + "f 3/3 1/1 2/2\nf 3/3 2/2 1/4\n");
  EXPECT_THAT(model.mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
  EXPECT_EQ(model.mesh.positions[0], V3f(1, 1, 0));
  EXPECT_EQ(model.mesh.positions[3], model.mesh.positions[1]);
}

TEST(ReadObj, TextureCoordinatesRunDownwards) {
  EXPECT_EQ(read(square + "vt 0.25 0.125\nf 1/1 2/1 3/1\n").uvs[0], V2f(0.25f, 0.875f));
}

TEST(ReadObj, NormalsOfAllCornersAreKept) {
  EXPECT_THAT(read(square + "vn 0 0 1\nf 1//1 2//1 3//1\n").normals,
              ElementsAre(V3f(0, 0, 1), V3f(0, 0, 1), V3f(0, 0, 1)));
}

TEST(ReadObj, WithoutAnyNormalThereAreNone) { EXPECT_THAT(read(square + "vn 0 0 1\nf 1 2 3\n").normals, IsEmpty()); }

TEST(ReadObj, CornersWithoutANormalKeepAZeroOneAndAreCounted) {
  SourceModel const model = read(square + "vn 0 0 1\nf 1//1 2//1 3\n");
  EXPECT_EQ(model.normals[2], V3f(0, 0, 0));
  EXPECT_THAT(model.notes, Contains(HasSubstr("1 vertices without a normal")));
}

TEST(ReadObj, VertexColoursAreSrgb) {
  SourceModel const model = read("v 0 0 0 1 0.5 0\nv 1 0 0 1 1 1\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(model.colours[0], (Rgba16{65535, 14027, 0, 65535}));
  EXPECT_EQ(model.colours[2], (Rgba16{65535, 65535, 65535, 65535}));
}

TEST(ReadObj, ColoursThatAreNoNumberAreBlack) {
  SourceModel const model = read("v 0 0 0 nan nan nan\nv 1 0 0 1 1 1\nv 0 1 0 1 1 1\nf 1 2 3\n");
  EXPECT_EQ(model.colours[0], (Rgba16{0, 0, 0, 65535}));
}

TEST(ReadObj, AContinuedLineIsOne) { EXPECT_EQ(read(square + "f 1 2 \\\n3 \\\r\n4\n").mesh.triangles.size(), 2u); }

TEST(ReadObj, LineNumbersSurviveContinuedLines) {
  EXPECT_THAT(failure(square + "f 1 2 \\\n3\nf 1 2 7\n"), HasSubstr("line 7"));
}

TEST(ReadObj, TheLastFaceNeedsNoLineEnd) {
  SourceModel const model = read(square + "f 1 2 3");
  EXPECT_THAT(model.mesh.triangles, SizeIs(1));
  EXPECT_THAT(model.notes, Contains(HasSubstr("cut off")));
}

TEST(ReadObj, AFaceOfTwoCornersIsLeftOutAndCounted) {
  SourceModel const model = read(square + "f 1 2\nf 1 2 3\n");
  EXPECT_THAT(model.mesh.triangles, SizeIs(1));
  EXPECT_THAT(model.notes, Contains(HasSubstr("1 faces of fewer than three corners")));
}

TEST(ReadObj, SmallThingsFarFromZeroKeepTheirDetail) {
  SourceModel const model =
      read("v 500000.001 4000000 0\nv 500000.002 4000000 0\nv 500000.001 4000000.001 0\nf 1 2 3\n");
  EXPECT_NEAR(model.mesh.positions[1].x - model.mesh.positions[0].x, 0.001, 1e-7);
  EXPECT_NEAR(model.origin.x + model.mesh.positions[0].x, 500000.001, 1e-7);
}

TEST(ReadObj, AnIndexOutOfRangeIsAnErrorWithLineAndCount) {
  EXPECT_THAT(failure(square + "f 1 2 5\n"), testing::AllOf(HasSubstr("line 5"), HasSubstr("vertex 5 of 4")));
  EXPECT_THAT(failure(square + "f 1 2 -5\n"), HasSubstr("vertex -5 of 4"));
  EXPECT_THAT(failure(square + "f 0 1 2\n"), HasSubstr("vertex 0 of 4"));
  EXPECT_THAT(failure(square + "f 1 2 99999999999999999999\n"), HasSubstr("a face names"));
}

TEST(ReadObj, WordsThatAreNoNumbersAreErrors) {
  EXPECT_THAT(failure("v 0 zero 0\nf 1 1 1\n"), HasSubstr("line 1"));
  EXPECT_THAT(failure("v 0 0\nf 1 1 1\n"), HasSubstr("line 1"));
}

TEST(ReadObj, PointsAloneAreRefused) { EXPECT_THAT(failure(square), HasSubstr("4 points alone")); }

TEST(ReadObj, TheLimitOnTrianglesHolds) {
  ReadOptions options;
  options.limits.triangles = 1;
  EXPECT_THAT(failure(square + "f 1 2 3 4\n", options), HasSubstr("2 triangles exceed the limit of 1"));
}

TEST(ReadObj, MaterialsAreKeptPerFaceInTheOrderOfUse) {
  Folder const folder{{"m.mtl", "newmtl b\nKd 0 0 1\nnewmtl a\nKd 1 0 0\n"}};
  SourceModel const model =
      read("mtllib m.mtl\n" + square + "usemtl never\nusemtl a\nf 1 2 3\nusemtl b\nf 1 3 4\n", folder);
  ASSERT_THAT(model.materials, SizeIs(2));
  EXPECT_EQ(model.materials[0].base_colour, (Rgba{1, 0, 0, 1}));
  EXPECT_THAT(model.face_materials, ElementsAre(0, 1));
  EXPECT_TRUE(has_colour(model));
}

TEST(ReadObj, AMaterialWithoutKdHasNoColour) {
  SourceModel const model =
      read("mtllib m.mtl\n" + square + "usemtl a\nf 1 2 3\n", {{"m.mtl", "newmtl a\nKa 1 1 1\n"}});
  EXPECT_FALSE(has_colour(model));
}

TEST(ReadObj, VertexColoursStandAloneWithoutKd) {
  SourceModel const model = read("v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\nf 1 2 3\n");
  EXPECT_EQ(model.materials[0].base_colour, (Rgba{1, 1, 1, 1}));
}

TEST(ReadObj, LibraryNamesMayHoldSpacesOrBeSeveral) {
  Folder const folder{
      {"my scan.mtl", "newmtl a\nKd 1 0 0\n"}, {"b.mtl", "newmtl b\nKd 1 0 0\n"}, {"c.mtl", "newmtl c\nKd 1 0 0\n"}};
  EXPECT_TRUE(read("mtllib my scan.mtl\n" + square + "usemtl a\nf 1 2 3\n", folder).materials[0].coloured);
  EXPECT_TRUE(read("mtllib b.mtl c.mtl\n" + square + "usemtl c\nf 1 2 3\n", folder).materials[0].coloured);
}

TEST(ReadObj, WhatIsMissingOrLeadsOutIsNotedAndTheRestRead) {
  SourceModel const model =
      read("mtllib gone.mtl\nmtllib ../up.mtl\nmtllib m.mtl\n" + mapped_square + "usemtl a\n" + mapped_face,
           {{"m.mtl", "newmtl a\nmap_Kd gone.png\nnorm broken.png\n"}, {"broken.png", "GIF8"}});
  EXPECT_THAT(model.notes, testing::IsSupersetOf({HasSubstr("gone.mtl"), HasSubstr("leads out"), HasSubstr("gone.png"),
                                                  HasSubstr("broken.png")}));
  EXPECT_THAT(model.images, IsEmpty());
  EXPECT_FALSE(has_colour(model));
}

SourceModel with_material(std::string const& mtl, ReadOptions const& options = {}) {
  Folder const folder{{"m.mtl", "newmtl a\n" + mtl}, {"wood grain.png", png_of(200)}, {"n.png", png_of(100)}};
  return read("mtllib m.mtl\n" + mapped_square + "usemtl a\n" + mapped_face, folder, options);
}

TEST(ReadObj, KdBesideAMapIsIgnoredUnlessAskedFor) {
  std::string const mtl = "Kd 0 1 1\nmap_Kd wood grain.png\n";
  SourceModel const model = with_material(mtl);
  EXPECT_EQ(model.materials[0].base_colour, (Rgba{1, 1, 1, 1}));
  EXPECT_THAT(model.notes, Contains(HasSubstr("Kd of material \"a\" ignored")));
  ReadOptions multiply;
  multiply.mtl_kd = MtlKd::multiply;
  EXPECT_EQ(with_material(mtl, multiply).materials[0].base_colour, (Rgba{0, 1, 1, 1}));
}

TEST(ReadObj, BlackBesideAMapIsNeverMeant) {
  ReadOptions multiply;
  multiply.mtl_kd = MtlKd::multiply;
  EXPECT_EQ(with_material("Kd 0 0 0\nmap_Kd wood grain.png\n", multiply).materials[0].base_colour, (Rgba{1, 1, 1, 1}));
}

TEST(ReadObj, MapOptionsAreNotPartOfTheFileName) {
  TextureUse const use = with_material("map_Kd -blendu on -s 2 4 1 -o 0.5 0.25 -mm 0 1 -clamp on wood grain.png\n")
                             .materials[0]
                             .colour_map;
  ASSERT_EQ(use.image, 0);
  EXPECT_EQ(use.wrap_u, Wrap::clamp);
  // OBJ's (u, v) = (0, 0), which we store as (0, 1), moves to (0.5, 0.25), which we store as (0.5, 0.75).
  EXPECT_FLOAT_EQ(use.matrix[0] * 0 + use.matrix[1] * 1 + use.matrix[2], 0.5f);
  EXPECT_FLOAT_EQ(use.matrix[3] * 0 + use.matrix[4] * 1 + use.matrix[5], 0.75f);
}

TEST(ReadObj, NormIsTheNormalMapAndLinear) {
  SourceModel const model = with_material("map_Kd wood grain.png\nnorm n.png\nbump n.png\n");
  ASSERT_EQ(model.materials[0].normal_map.image, 1);
  EXPECT_EQ(model.images[1].space, ColourSpace::linear);
  EXPECT_THAT(model.notes, Contains(HasSubstr("bump of material")));
}

TEST(ReadObj, OpacityIsDOrTheRestOfTr) {
  EXPECT_FLOAT_EQ(with_material("d 0.25\n").materials[0].base_colour[3], 0.25f);
  EXPECT_FLOAT_EQ(with_material("Tr 0.25\n").materials[0].base_colour[3], 0.75f);
  EXPECT_EQ(with_material("d 0.25\n").materials[0].alpha, AlphaMode::blend);
}

TEST(ReadObj, TwoMaterialsShareOneImage) {
  Folder const folder{{"m.mtl", "newmtl a\nmap_Kd t.png\nnewmtl b\nmap_Kd t.png\n"}, {"t.png", png_of(9)}};
  SourceModel const model =
      read("mtllib m.mtl\n" + mapped_square + "usemtl a\n" + mapped_face + "usemtl b\n" + mapped_face, folder);
  EXPECT_THAT(model.images, SizeIs(1));
}

}  // namespace
