// SPDX-License-Identifier: Apache-2.0
#include "stages/render.h"

#include "stages/clean.h"
#include "stages/compare.h"
#include "stages/shade.h"
#include "tests/support/meshes.h"

#include <gmock/gmock.h>
#include <oneapi/tbb/global_control.h>

#include <cmath>
#include <numbers>
#include <numeric>

namespace vitrine {
namespace {

SurveyedModel surveyed(SourceModel model) { return survey(std::make_shared<SourceModel const>(std::move(model))); }

/// A square of edge 2 in the xy plane, facing +Z, in one linear colour.
SourceModel quad(Rgba colour) {
  SourceModel model;
  model.mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  model.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  model.materials[0].base_colour = colour;
  model.materials[0].coloured = true;
  return model;
}

/// A camera in front of the unit sphere about the origin, looking along -Z.
Camera front() { return camera({{0, 0, 0}, 1}, {0, 0, 1}); }
Camera back() { return camera({{0, 0, 0}, 1}, {0, 0, -1}); }

constexpr PictureOptions kSmall{48, Light::head, false};

Image picture(SourceModel model, Camera const& from = front(), PictureOptions const& options = kSmall) {
  return render(surveyed(std::move(model)), {from}, options)[0];
}

std::array<int, 4> texel(Image const& image, int x, int y) {
  std::uint8_t const* t = &image.texels[4u * (y * image.width + x)];
  return {t[0], t[1], t[2], t[3]};
}

std::array<int, 4> middle(Image const& image) { return texel(image, image.width / 2, image.height / 2); }

double coverage(Image const& image) {
  double sum = 0;
  for (std::size_t i = 3; i < image.texels.size(); i += 4) sum += image.texels[i];
  return sum / 255;
}

TEST(Render, ALitSquareHasTheValueOfItsShading) {
  V3f const z(0, 0, 1);
  V3f const light = Shading(z, z)({0.2f, 0.5f, 0.8f}, z);
  EXPECT_THAT(middle(picture(quad({0.2f, 0.5f, 0.8f, 1}))),
              testing::ElementsAre(srgb_byte(light.x), srgb_byte(light.y), srgb_byte(light.z), 255));
}

TEST(Render, WhatIsNotCoveredIsWhite) {
  EXPECT_THAT(texel(picture(quad({0, 0, 0, 1}), front(), {}), 0, 0), testing::ElementsAre(255, 255, 255, 0));
}

TEST(Render, BothSidesAreLitAlike) {
  EXPECT_EQ(middle(picture(quad({0.2f, 0.5f, 0.8f, 1}), back())), middle(picture(quad({0.2f, 0.5f, 0.8f, 1}))));
}

TEST(Render, AHalfCoveredPixelIsTheMeanOfBytes) {
  SourceModel half = quad({0, 0, 0, 1});
  half.materials[0].unlit = true;
  for (V3f& p : half.mesh.positions) p.x += 1;
  PictureOptions options;
  options.size = 21;  // the edge runs through the middle of a pixel
  EXPECT_THAT(middle(picture(half, front(), options)), testing::ElementsAre(128, 128, 128, 128));
}

TEST(Render, AnUnlitColourIsOnlyEncoded) {
  SourceModel model = quad({0.2f, 0.5f, 0.8f, 1});
  model.materials[0].unlit = true;
  EXPECT_THAT(middle(picture(model)), testing::ElementsAre(srgb_byte(0.2f), srgb_byte(0.5f), srgb_byte(0.8f), 255));
}

TEST(Render, EmissionIsAddedToWhatIsLit) {
  SourceModel model = quad({0.2f, 0.5f, 0.1f, 1});
  model.materials[0].emission = {0.3f, 0, 0.9f};
  V3f const z(0, 0, 1);
  V3f const seen = Shading(z, z)({0.2f, 0.5f, 0.1f}, z) + model.materials[0].emission;
  auto const shown = testing::ElementsAre(srgb_byte(seen.x), srgb_byte(seen.y), srgb_byte(seen.z), 255);
  EXPECT_THAT(middle(picture(model)), shown);
  model.materials[0].alpha = AlphaMode::mask;  // drawn through rays
  EXPECT_THAT(middle(picture(model)), shown);
}

TEST(Render, GreyTakesThePlaceOfTheColour) {
  PictureOptions grey = kSmall;
  grey.grey = true;
  EXPECT_EQ(middle(picture(quad({1, 0, 0, 1}), front(), grey)), middle(picture(quad({0.5f, 0.5f, 0.5f, 1}))));
}

TEST(Render, SideLightComesFromTheUpperLeft) {
  PictureOptions side = kSmall;
  side.light = Light::side;
  Image const ball = picture(clean(test::painted_model(test::sphere())).model, front(), side);
  EXPECT_GT(texel(ball, 16, 16)[1], texel(ball, 32, 32)[1] + 30);
  EXPECT_GT(texel(ball, 24, 16)[1], texel(ball, 32, 24)[1]);
}

TEST(Render, CutOutFacesLetTheRayPass) {
  SourceModel model = quad({0, 0, 0, 0.4f});
  model.materials[0].alpha = AlphaMode::mask;
  EXPECT_THAT(middle(picture(model)), testing::ElementsAre(255, 255, 255, 0));
  model.materials[0].alpha_cutoff = 0.4f;
  EXPECT_EQ(middle(picture(model))[3], 255);
}

TEST(Render, BlendedFacesAreLaidOverWhatLiesBehind) {
  SourceModel model = quad({1, 1, 1, 1});
  model.mesh.positions.insert(model.mesh.positions.end(), {{-1, -1, -.1f}, {1, -1, -.1f}, {1, 1, -.1f}, {-1, 1, -.1f}});
  model.mesh.triangles.insert(model.mesh.triangles.end(), {{4, 5, 6}, {4, 6, 7}});
  model.materials.push_back(model.materials[0]);
  model.face_materials = {0, 0, 1, 1};
  model.materials[0].base_colour = {0, 0, 0, 0.4f};
  model.materials[0].alpha = AlphaMode::blend;
  for (Material& material : model.materials) material.unlit = true;
  EXPECT_THAT(middle(picture(model)), testing::ElementsAre(153, 153, 153, 255));
  model.materials[1] = model.materials[0];
  EXPECT_THAT(middle(picture(model)), testing::ElementsAre(92, 92, 92, 163));
}

TEST(Render, TheSilhouetteOfASphereIsADisk) {
  Image const ball = picture(clean(test::plain_model(test::sphere(256, 128))).model);
  double const share = coverage(ball) / (48.0 * 48);
  EXPECT_NEAR(share, std::numbers::pi / 4, 1e-3);
}

TEST(Render, FarFromTheOriginNothingChanges) {
  SourceModel near = clean(test::painted_model(test::torus())).model, far = near;
  far.origin = {1e8, -1e8, 1e8};
  V3d const direction = directions(ViewSet::turntable, 32)[3];
  Image const a = picture(near, camera(bounding_sphere(near), direction));
  Image const b = picture(far, camera(bounding_sphere(far), direction));
  EXPECT_LT(compare(a, b).mse1e4, 0.01);
}

TEST(Render, ADistantTextureIsItsMean) {
  SourceModel model = quad({1, 1, 1, 1});
  model.uvs = {{0, 999}, {999, 999}, {999, 0}, {0, 0}};
  model.images.push_back({2, 2, 1, ColourSpace::srgb, {0, 255, 255, 0}});
  model.materials[0].colour_map.image = 0;
  model.materials[0].unlit = true;
  EXPECT_NEAR(middle(picture(model))[0], srgb_byte(0.5f), 1);
}

TEST(Render, RaysAndTheDepthBufferShowTheSame) {
  SourceModel model = clean(test::painted_model(test::torus(64, 32))).model;
  Camera const from = camera(bounding_sphere(model), directions(ViewSet::sphere, 5)[3]);
  Image const drawn = picture(model, from);
  model.materials[0].alpha = AlphaMode::blend;  // whose layers take rays
  EXPECT_LT(compare(drawn, picture(model, from)).mse1e4, 0.02);
}

/// The same model, but with a texture over it that changes nothing.
SourceModel mapped(SourceModel model) {
  model.uvs.assign(model.mesh.positions.size(), {0, 0});
  model.images = {{1, 1, 3, ColourSpace::linear, {255, 255, 255}}};
  model.materials[0].occlusion_map.image = 0;
  return model;
}

TEST(Render, SampleBySampleAndFaceByFaceShowTheSame) {
  SourceModel const many = clean(test::painted_model(test::bumpy_sphere(320, 160))).model;
  ASSERT_GT(many.mesh.triangles.size(), 50'000u);
  for (bool const grey : {false, true}) {
    PictureOptions const options{64, Light::side, grey};
    EXPECT_EQ(picture(many, front(), options).texels, picture(mapped(many), front(), options).texels);
  }
}

TEST(Render, FewerSamplesPerPixelAreRougherOnly) {
  SourceModel const model = clean(test::painted_model(test::torus())).model;
  Camera const from = camera(bounding_sphere(model), directions(ViewSet::sphere, 5)[3]);
  for (AlphaMode alpha : {AlphaMode::opaque, AlphaMode::blend})
    for (int supersample : {1, 2, 3}) {
      SourceModel same = model;
      same.materials[0].alpha = alpha;
      PictureOptions rough = kSmall;
      rough.supersample = supersample;
      EXPECT_LT(compare(picture(model, from), picture(same, from, rough)).mse1e4, 60 / (supersample * supersample));
    }
}

TEST(Render, ThreadsDoNotChangeABit) {
  SurveyedModel const model = surveyed(clean(test::painted_model(test::bumpy_sphere(40, 20))).model);
  std::vector<Camera> cameras;
  for (V3d const& direction : directions(ViewSet::sphere, 5))
    cameras.push_back(camera(bounding_sphere(*model.model), direction));
  std::vector<Image> const many = render(model, cameras, kSmall);
  tbb::global_control const one(tbb::global_control::max_allowed_parallelism, 1);
  std::vector<Image> const alone = render(model, cameras, kSmall);
  for (std::size_t i = 0; i < many.size(); ++i) EXPECT_EQ(many[i].texels, alone[i].texels);
}

}  // namespace
}  // namespace vitrine
