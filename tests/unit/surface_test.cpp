// SPDX-License-Identifier: Apache-2.0
#include "stages/surface.h"

#include "stages/colour.h"
#include "tests/support/meshes.h"

#include <gmock/gmock.h>

namespace vitrine {
namespace {

using testing::ElementsAre;
using testing::FloatEq;
using testing::FloatNear;

/// A triangle in the xy plane, facing +Z, with texture coordinates as an upright image has them.
SourceModel textured_triangle(Image image) {
  SourceModel model = test::plain_model(test::triangle());
  model.normals.assign(3, {0, 0, 1});
  model.uvs = {{0, 1}, {1, 1}, {0, 0}};
  model.images = {std::move(image)};
  model.materials[0].coloured = true;
  model.materials[0].colour_map.image = 0;
  return model;
}

Image stripes() { return {2, 1, 3, ColourSpace::srgb, {255, 0, 0, 0, 0, 255}}; }

TEST(Surface, ColourIsFactorTimesTextureTimesVertexColour) {
  SourceModel model = textured_triangle({1, 1, 3, ColourSpace::srgb, {255, 128, 0}});
  model.materials[0].base_colour = {0.5f, 1, 1, 1};
  model.colours = {{65535, 0, 0, 65535}, {65535, 65535, 0, 65535}, {65535, 65535, 65535, 65535}};
  auto const colour = Surface(model).sample({0, 0.25f, 0.5f}, 0).colour;
  EXPECT_THAT(colour, ElementsAre(FloatEq(0.5f), FloatEq(0.75f * srgb_to_linear(128.f / 255)), 0, 1));
}

TEST(Surface, NormalsAreInterpolatedAndUnit) {
  SourceModel model = test::plain_model(test::triangle());
  model.normals = {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_NEAR((Surface(model).sample({0, 0.5f, 0}, 0).normal - V3f(1, 0, 1).normalized()).length(), 0, 1e-6f);
}

TEST(Surface, AFaceWithoutUsableNormalsShowsItsOwn) {
  SourceModel model = test::plain_model(test::triangle());
  EXPECT_EQ(Surface(model).sample({0, 0.2f, 0.2f}, 0).normal, V3f(0, 0, 1));
  model.normals = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}};
  EXPECT_EQ(Surface(model).sample({0, 0.5f, 0}, 0).normal, V3f(0, 0, 1));
}

TEST(Surface, AFootprintAsWideAsTheTextureSeesItsMean) {
  SourceModel const model = textured_triangle(stripes());
  Surface const surface(model);
  EXPECT_THAT(surface.sample({0, 0.25f, 0.25f}, 0).colour, ElementsAre(1, 0, 0, 1));
  EXPECT_THAT(surface.sample({0, 0.25f, 0.25f}, 2).colour,
              ElementsAre(FloatNear(0.5f, 0.003f), 0, FloatNear(0.5f, 0.003f), 1));
}

TEST(Surface, AsClientsDrawItATextureWithoutSmallerVersionsIsReadAsItIs) {
  SourceModel model = textured_triangle(stripes());
  Places at;
  at.count = 1, at.u[0] = at.v[0] = 0.25f;
  at.step_u[0][0] = 1, at.step_v[0][0] = at.step_u[1][0] = at.step_v[1][0] = 0;
  auto const red = [&](bool mipmapped) {
    model.materials[0].colour_map.mipmapped = mipmapped;
    Surface const surface(model);
    SurfaceLanes lanes;
    surface.sample(surface.facet(0), at, lanes);
    return lanes.colour[0][0];
  };
  EXPECT_FLOAT_EQ(red(false), 1);
  EXPECT_NEAR(red(true), 0.5f, 0.003f);
}

TEST(Surface, TextureTransformsApply) {
  SourceModel model = textured_triangle(stripes());
  model.materials[0].colour_map.matrix = {1, 0, 0.5f, 0, 1, 0};
  EXPECT_THAT(Surface(model).sample({0, 0.25f, 0.25f}, 0).colour, ElementsAre(0, 0, 1, 1));
}

TEST(Surface, NormalMapsTiltTheNormalWithGreenUpAndScaleApplied) {
  SourceModel model = textured_triangle({1, 1, 3, ColourSpace::linear, {128, 255, 128}});
  model.materials[0].normal_map.image = 0;
  V3f const normal = Surface(model).sample({0, 0.2f, 0.2f}, 0).normal;
  EXPECT_GT(normal.y, 0.99f);
  model.materials[0].normal_scale = 0;
  EXPECT_EQ(Surface(model).sample({0, 0.2f, 0.2f}, 0).normal, V3f(0, 0, 1));
}

TEST(Surface, NormalMapsFollowTheFilesOwnTangents) {
  SourceModel model = textured_triangle({1, 1, 3, ColourSpace::linear, {128, 255, 128}});
  model.materials[0].normal_map.image = 0;
  model.tangents.assign(3, V4f(0, 1, 0, 1));  // T = +Y, so B = N x T = -X
  EXPECT_LT(Surface(model).sample({0, 0.2f, 0.2f}, 0).normal.x, -0.99f);
  model.tangents.assign(3, V4f(0, 1, 0, -1));
  EXPECT_GT(Surface(model).sample({0, 0.2f, 0.2f}, 0).normal.x, 0.99f);
  model.tangents.assign(3, V4f(0, 0, 0, 0));  // none here: as without
  EXPECT_GT(Surface(model).sample({0, 0.2f, 0.2f}, 0).normal.y, 0.99f);
}

TEST(Surface, CoverageFollowsTheAlphaMode) {
  SourceModel model = test::plain_model(test::triangle());
  Material& material = model.materials[0];
  material.base_colour = {1, 1, 1, 0.4f};
  EXPECT_EQ(Surface(model).sample({}, 0).colour[3], 1);
  material.alpha = AlphaMode::blend;
  EXPECT_EQ(Surface(model).sample({}, 0).colour[3], 0.4f);
  material.alpha = AlphaMode::mask;
  EXPECT_EQ(Surface(model).sample({}, 0).colour[3], 0);
  material.alpha_cutoff = 0.4f;
  EXPECT_EQ(Surface(model).sample({}, 0).colour[3], 1);
}

TEST(Surface, OnlyColourThatVariesCountsAsColoured) {
  SourceModel model = test::plain_model(test::cube());
  EXPECT_FALSE(Surface(model).coloured());
  model.colours.assign(8, {65535, 0, 0, 65535});
  EXPECT_FALSE(Surface(model).coloured());
  EXPECT_THAT(Surface(model).uniform_colour(), ElementsAre(1, 0, 0, 1));
  model.colours[3] = {0, 0, 0, 65535};
  EXPECT_TRUE(Surface(model).coloured());
}

TEST(Surface, AThumbnailIsPaintedAsBrightAsWhatEmits) {
  SourceModel model = textured_triangle({1, 1, 3, ColourSpace::srgb, {255, 255, 255}});
  model.materials[0].base_colour = {0.1f, 0.1f, 0.1f, 1};
  model.materials[0].emission = {0, 0.4f, 1};
  model.materials[0].emission_map.image = 0;
  EXPECT_TRUE(Surface(model).emissive());
  EXPECT_THAT(Surface(model).sample({}, 0).colour, ElementsAre(FloatEq(0.1f), FloatEq(0.1f + 0.4f / 0.8f), 1, 1));
  model.materials[0].unlit = true;
  EXPECT_FALSE(Surface(model).emissive());
}

TEST(Surface, AThumbnailBlendsWhereMostDoes) {
  SourceModel house = test::plain_model(test::cube());
  house.materials.resize(3);
  house.materials[1].alpha = AlphaMode::blend;
  house.materials[2].alpha = AlphaMode::mask;
  house.face_materials.assign(12, 0);
  house.face_materials[0] = 1;
  EXPECT_EQ(Surface(house).alpha(), AlphaMode::blend);
  EXPECT_EQ(Surface(house).common_alpha(), AlphaMode::opaque);
  house.face_materials[1] = 2;
  EXPECT_EQ(Surface(house).common_alpha(), AlphaMode::mask);
  std::fill_n(house.face_materials.begin(), 7, std::uint16_t{1});
  EXPECT_EQ(Surface(house).common_alpha(), AlphaMode::blend);
}

TEST(Surface, OnlyMaterialsInUseCount) {
  SourceModel model = test::plain_model(test::cube());
  model.materials.resize(3);
  model.materials[0].base_colour = {1, 0, 0, 1};
  model.materials[0].coloured = model.materials[1].coloured = true;
  model.materials[1].base_colour = {0, 1, 0, 1};
  model.materials[1].double_sided = true;
  model.materials[2].alpha = AlphaMode::blend;
  model.materials[0].unlit = true;
  model.face_materials.assign(12, 0);
  EXPECT_FALSE(Surface(model).coloured());
  EXPECT_FALSE(Surface(model).double_sided());
  EXPECT_TRUE(Surface(model).unlit());
  EXPECT_EQ(Surface(model).alpha(), AlphaMode::opaque);
  model.face_materials[7] = 1;
  EXPECT_TRUE(Surface(model).coloured());
  EXPECT_TRUE(Surface(model).double_sided());
  EXPECT_FALSE(Surface(model).unlit());
  EXPECT_THAT(Surface(model).sample({7, 0, 0}, 0).colour, ElementsAre(0, 1, 0, 1));
}

TEST(Survey, ASceneAndASurfaceOverOneModel) {
  auto const model = std::make_shared<SourceModel const>(test::painted_model(test::cube()));
  SurveyedModel const surveyed = survey(model);
  auto const hit = surveyed.scene.first_hit({{0.1f, 0.1f, 5}, {0, 0, -1}});
  ASSERT_TRUE(hit);
  EXPECT_GT(surveyed.surface.sample(*hit, 0).normal.z, 0.5f);
}

}  // namespace
}  // namespace vitrine
