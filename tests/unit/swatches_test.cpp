// SPDX-License-Identifier: Apache-2.0
#include "stages/swatches.h"

#include "io/read_model.h"
#include "io/write_glb.h"
#include "stages/clean.h"
#include "stages/colour.h"
#include "stages/paint.h"
#include "tests/support/bytes.h"
#include "tests/support/meshes.h"

#include <gmock/gmock.h>

#include <memory>

namespace vitrine {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

constexpr std::size_t kSamples = 20'000;

V3f bytes(int red, int green, int blue) { return V3f(float(red), float(green), float(blue)) / 255; }

SurfaceSamples showing(std::vector<std::pair<V3f, int>> const& colours) {
  SurfaceSamples samples;
  for (auto const& [colour, count] : colours)
    samples.colours.insert(samples.colours.end(), std::size_t(count), V4f(colour.x, colour.y, colour.z, 1));
  return samples;
}

std::vector<std::pair<V3f, int>> patches(int count) {
  std::vector<std::pair<V3f, int>> found;
  for (int i = 0; i < count; ++i) found.push_back({bytes(4 * (i % 60), 200 * (i / 60), 0), 10});
  return found;
}

TEST(FlatColours, AreFew) {
  V3f const red = bytes(200, 10, 10), blue = bytes(10, 10, 200);
  EXPECT_THAT(flat_colours(showing({{red, 40}, {blue, 60}})), testing::ElementsAre(blue, red));
  EXPECT_THAT(flat_colours(showing(patches(64))), SizeIs(64));
  EXPECT_THAT(flat_colours(showing(patches(65))), IsEmpty());
  EXPECT_THAT(flat_colours({}), IsEmpty());
}

TEST(FlatColours, LeaveOutWhatFiltersMixed) {
  V3f const red = bytes(200, 10, 10), blue = bytes(10, 10, 200), mixed = bytes(100, 10, 100), lamp = bytes(250, 250, 0);
  EXPECT_THAT(flat_colours(showing({{red, 597}, {blue, 400}, {mixed, 3}})), testing::ElementsAre(red, blue));
  EXPECT_THAT(flat_colours(showing({{red, 5970}, {blue, 4000}, {lamp, 10}})), testing::ElementsAre(red, blue, lamp));
  EXPECT_THAT(flat_colours(showing({{red, 597}, {blue, 200}, {mixed, 5}})), IsEmpty());
}

TEST(FlatColours, AreNoRamp) {
  std::vector<std::pair<V3f, int>> ramp;
  for (int grey = 0; grey < 256; ++grey) ramp.push_back({bytes(grey, grey, grey), 10});
  EXPECT_THAT(flat_colours(showing(ramp)), IsEmpty());
}

TEST(FlatColours, ThatDifferByNoiseAreOne) {
  V3f const red = bytes(200, 10, 10), nearly = bytes(198, 12, 10);
  EXPECT_THAT(flat_colours(showing({{red, 950}, {nearly, 50}})), testing::ElementsAre(red));
}

/// A cube of which each side has a material of its own.
SourceModel painted_cube(int materials) {
  SourceModel model = test::plain_model(test::cube());
  model.materials.clear();
  for (int m = 0; m < materials; ++m) {
    Material& material = model.materials.emplace_back();
    material.coloured = true;
    V3f const colour = bytes(250 - 40 * m, 30 * m, m % 2 * 255);
    for (unsigned k = 0; k < 3; ++k) material.base_colour[k] = srgb_to_linear(colour[k]);
  }
  for (std::size_t f = 0; f < model.mesh.triangles.size(); ++f)
    model.face_materials.push_back(std::uint16_t(f / 2 % std::size_t(materials)));
  return model;
}

TEST(Swatches, ShowEachFaceInItsOwnColour) {
  for (int const materials : {2, 3, 6}) {
    SurveyedModel const original = survey(std::make_shared<SourceModel const>(clean(painted_cube(materials)).model));
    TriMesh const mesh = weld(*original.model);
    SurfaceSamples const samples = sample_surface(original, kSamples);
    EXPECT_THAT(samples.flat, SizeIs(materials));
    PaintOptions options;
    options.swatches = true;
    BakedModel const model = paint(quantize(mesh, cube_about(mesh, 12)), original, samples, options);
    EncodedThumbnail const file = io::encode(model, "");
    SurveyedModel const shown =
        survey(std::make_shared<SourceModel const>(io::read_model(".glb", io::own(file.glb), test::no_files)));
    auto const& p = shown.model->mesh.positions;
    for (std::uint32_t f = 0; f < shown.model->mesh.triangles.size(); ++f) {
      auto const& [a, b, c] = shown.model->mesh.triangles[f];
      auto const hit = original.scene.closest_point((p[a] + p[b] + p[c]) / 3, 1, {0, 0, 0});
      ASSERT_TRUE(hit);
      Rgba const wanted = original.surface.sample(*hit, 0).colour;
      for (auto const& [u, v] : {std::pair{0.3f, 0.3f}, {0.9f, 0.05f}, {0.f, 0.f}}) {
        Rgba const found = shown.surface.sample(Hit{f, u, v, 0}, 0).colour;
        for (unsigned k = 0; k < 3; ++k) EXPECT_NEAR(linear_to_srgb(found[k]), linear_to_srgb(wanted[k]), 1.0 / 255);
      }
    }
  }
}

TEST(Swatches, FacesWithoutASampleShowWhatIsClosest) {
  SurveyedModel const original = survey(std::make_shared<SourceModel const>(clean(painted_cube(6)).model));
  TriMesh const mesh = weld(*original.model);
  SurfaceSamples const all = sample_surface(original, kSamples);
  SurfaceSamples none;
  none.flat = all.flat;
  EXPECT_EQ(make_swatches(mesh, original, none).uvs, make_swatches(mesh, original, all).uvs);
}

TEST(Swatches, AreNotForSmoothColours) {
  SurveyedModel const original =
      survey(std::make_shared<SourceModel const>(clean(test::painted_model(test::sphere(48, 24))).model));
  EXPECT_THAT(sample_surface(original, kSamples).flat, IsEmpty());
}

}  // namespace
}  // namespace vitrine
