// SPDX-License-Identifier: Apache-2.0
#include "stages/own_texture.h"

#include "io/read_model.h"
#include "io/write_glb.h"
#include "stages/clean.h"
#include "stages/compare.h"
#include "stages/measure.h"
#include "tests/support/meshes.h"

#include <gmock/gmock.h>

#include <memory>

namespace vitrine {
namespace {

/// Two columns, red and blue.
Image stripes() { return {2, 1, 3, ColourSpace::srgb, {255, 0, 0, 0, 0, 255}}; }

/// A flat grid with `repetitions` of the stripes across.
SourceModel striped(int columns, float repetitions, float first = 0) {
  SourceModel model = test::plain_model(test::grid(columns, columns));
  for (V3f const& p : model.mesh.positions)
    model.uvs.push_back({first + repetitions * p.x / float(columns), p.z / float(columns)});
  model.images.push_back(stripes());
  model.materials[0].coloured = true;
  model.materials[0].colour_map.image = 0;
  return model;
}

BakedModel worn(SourceModel source, int triangles, int texture = 256) {
  SurveyedModel const original = survey(std::make_shared<SourceModel const>(clean(std::move(source)).model));
  std::optional<TexturedMesh> const textured = own_texture(*original.model);
  SurfaceSamples const samples = sample_surface(original, 2000);
  return wear_own_texture(simplify(*textured, triangles), *textured, original, samples,
                          {.position_bits = 12, .texture = texture});
}

TEST(OwnTexture, KeepsTheImageAndWhereItIsRead) {
  BakedModel const model = worn(striped(8, 1), 1000);
  EXPECT_EQ(model.colour->texels, stripes().texels);
  EXPECT_EQ(model.mesh.triangles.size(), 128u);
  EXPECT_EQ(model.uv_scale, V2f(1, 1));
  for (std::size_t f = 0; f < model.mesh.triangles.size(); ++f)
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(model.corner_uvs[f][k].x, (model.mesh.positions[model.mesh.triangles[f][k]].x) / 8, 0.003f);
}

TEST(OwnTexture, RepetitionsStayWithinTheUnitSquareByScale) {
  BakedModel const model = worn(striped(8, 5, -2.5f), 1000);
  EXPECT_NEAR(model.uv_scale.x, 5, 1e-4f);
  EXPECT_NEAR(model.uv_offset.x, 0.5f, 1e-4f);  // two and a half repetitions to the left, and three to the right
  for (CornerUvs const& corners : model.corner_uvs)
    for (V2f const& uv : corners) EXPECT_TRUE(uv.x >= 0 && uv.x <= 1);
}

TEST(OwnTexture, WholeRepetitionsAsideAreNoScale) { EXPECT_EQ(worn(striped(8, 1, 7), 1000).uv_scale, V2f(1, 1)); }

TEST(OwnTexture, FewerTrianglesShowTheSame) {
  BakedModel const model = worn(striped(16, 1), 8);
  EXPECT_LE(model.mesh.triangles.size(), 8u);
  for (std::size_t f = 0; f < model.mesh.triangles.size(); ++f)
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(model.corner_uvs[f][k].x, model.mesh.positions[model.mesh.triangles[f][k]].x / 16, 0.003f);
}

TEST(OwnTexture, IsRefusedWhereOneImageDoesNotTellAll) {
  EXPECT_TRUE(own_texture(striped(4, 1)));
  SourceModel painted = striped(4, 1);
  painted.colours.assign(painted.mesh.positions.size(), Rgba16{65535, 0, 0, 65535});
  EXPECT_FALSE(own_texture(painted));
  SourceModel two = striped(4, 1);
  two.materials.push_back(two.materials[0]);
  two.face_materials.assign(two.mesh.triangles.size(), 0);
  two.face_materials[3] = 1;
  EXPECT_TRUE(own_texture(two));
  two.materials[1].base_colour = {0, 1, 0, 1};
  EXPECT_FALSE(own_texture(two));
  EXPECT_FALSE(own_texture(striped(4, 1000)));
  EXPECT_FALSE(own_texture(test::plain_model(test::cube())));
}

SourceModel decoded(EncodedThumbnail const& file) {
  return io::read_model(".glb", io::own(file.glb), [](std::string_view) { return std::nullopt; });
}

/// What a client draws of the file differs from the original by the coding alone.
TEST(OwnTexture, IsDrawnAsTheOriginal) {
  for (Wrap wrap : {Wrap::repeat, Wrap::mirror, Wrap::clamp}) {
    SourceModel source = striped(8, 3, -0.75f);
    source.materials[0].colour_map.wrap_u = wrap;
    BakedModel const model = worn(source, 1000);
    io::EncodeOptions const options{.colour_codec = MapCodec::png};
    SurveyedModel const original = survey(std::make_shared<SourceModel const>(clean(source).model));
    SurveyedModel const thumbnail =
        survey(std::make_shared<SourceModel const>(decoded(io::encode(model, "", options))));
    Reference const seen = reference(original, {.count = 4, .size = 100});
    EXPECT_LT(compare(seen.pictures, pictures(thumbnail, seen)).mean.mse1e4, 1) << int(wrap);
  }
}

}  // namespace
}  // namespace vitrine
