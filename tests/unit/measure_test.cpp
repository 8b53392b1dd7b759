// SPDX-License-Identifier: Apache-2.0
#include "stages/measure.h"

#include "stages/clean.h"
#include "stages/closest_point.h"
#include "tests/support/meshes.h"

#include <gmock/gmock.h>

#include <cmath>

namespace vitrine {
namespace {

SurveyedModel surveyed(SourceModel model) {
  return survey(std::make_shared<SourceModel const>(clean(std::move(model)).model));
}

Comparison measure(SourceModel original, SourceModel thumbnail, MeasureOptions options = {}) {
  options.count = 4;
  options.size = 40;
  Reference const made = reference(surveyed(std::move(original)), options);
  return compare(made.pictures, pictures(surveyed(std::move(thumbnail)), made));
}

TEST(Measure, AModelAgainstItselfIsWithoutError) {
  for (ViewSet set : {ViewSet::turntable, ViewSet::sphere})
    for (Light light : {Light::head, Light::side}) {
      MeasureOptions options;
      options.views = set;
      options.light = light;
      EXPECT_EQ(measure(test::painted_model(test::torus()), test::painted_model(test::torus()), options).mean.mse1e4,
                0);
    }
}

TEST(Measure, FewerTrianglesAreMoreError) {
  auto const error = [](int slices) {
    return measure(test::plain_model(test::sphere(64, 32)), test::plain_model(test::sphere(slices, slices / 2)))
        .mean.mse1e4;
  };
  EXPECT_LT(error(32), error(16));
  EXPECT_LT(error(16), error(8));
}

TEST(Measure, AShiftCountsAsError) {
  EXPECT_GT(measure(test::plain_model(test::cube()), test::plain_model(test::cube({0.2f, 0, 0}))).mean.mse1e4, 10);
}

TEST(Measure, WithoutAnyColourBothAreGrey) {
  SourceModel thumbnail = test::plain_model(test::cube());
  thumbnail.materials[0].base_colour = {1, 0, 0, 1};
  EXPECT_EQ(measure(test::plain_model(test::cube()), thumbnail).mean.mse1e4, 0);
}

TEST(Measure, AThumbnailPaintedWithoutReasonIsDrawnAsItIs) {
  EXPECT_GT(measure(test::plain_model(test::cube()), test::painted_model(test::cube())).mean.mse1e4, 10);
}

/// A cup: its inside is dark.
TriMesh cup() {
  TriMesh mesh = test::open_cone();
  for (V3f& p : mesh.positions) p.y *= -3;  // which turns its outside in
  return mesh;
}

/// The cup seen from above, its thumbnail painted or occluded by `thumbnail`.
double error_of_cup(Occlusion occlusion, SourceModel const& thumbnail) {
  MeasureOptions options;
  options.occlusion = occlusion;
  options.views = ViewSet::sphere;
  options.count = 4;
  options.size = 40;
  auto const original = std::make_shared<SourceModel const>(clean(test::plain_model(cup())).model);
  Reference const made = reference(survey(original, 64), options);
  return compare(made.pictures, pictures(surveyed(thumbnail), made)).mean.mse1e4;
}

/// A finely divided cup whose vertices, or the texels of whose map, hold the occlusion of their places.
SourceModel occluded_cup(Occlusion occlusion) {
  SurveyedModel const traced = survey(std::make_shared<SourceModel const>(clean(test::plain_model(cup())).model), 64);
  SourceModel made;
  for (std::uint32_t face = 0; face < traced.model->mesh.triangles.size(); ++face) {
    Triangle const& t = traced.model->mesh.triangles[face];
    constexpr int n = 24;
    auto const add = [&](int i, int j) {
      Barycentric const at{float(i) / n, float(j) / n};
      auto const& p = traced.model->mesh.positions;
      auto const& m = traced.model->normals;
      made.mesh.positions.push_back(interpolate(p[t[0]], p[t[1]], p[t[2]], at));
      made.normals.push_back(interpolate(m[t[0]], m[t[1]], m[t[2]], at).normalized());
      float const open = traced.occlusion->at(traced.model->mesh, {face, at.u, at.v, 0});
      std::uint16_t const grey = std::uint16_t(std::lround(open * 65535));
      made.colours.push_back({grey, grey, grey, 65535});
      made.uvs.push_back({open, 0.5f});
      return std::uint32_t(made.mesh.positions.size() - 1);
    };
    for (int j = 0; j < n; ++j)
      for (int i = 0; i + j < n; ++i) {
        made.mesh.triangles.push_back({add(i, j), add(i + 1, j), add(i, j + 1)});
        if (i + j + 1 < n) made.mesh.triangles.push_back({add(i + 1, j), add(i + 1, j + 1), add(i, j + 1)});
      }
  }
  if (occlusion == Occlusion::colour) return made;
  made.colours.clear();
  made.images = {{256, 1, 1, ColourSpace::linear, {}}};  // texel i is i: u is the occlusion itself
  for (int i = 0; i < 256; ++i) made.images[0].texels.push_back(std::uint8_t(i));
  made.materials[0].occlusion_map = {.image = 0, .wrap_u = Wrap::clamp, .wrap_v = Wrap::clamp};
  return made;
}

TEST(Measure, WithOcclusionBothSidesShowTheirOwn) {
  SourceModel const plain = test::plain_model(cup());
  for (Occlusion occlusion : {Occlusion::occlusion, Occlusion::colour}) {
    double const without = error_of_cup(occlusion, plain), with = error_of_cup(occlusion, occluded_cup(occlusion));
    EXPECT_GT(without, 5);
    EXPECT_LT(with, without / 50);
  }
}

TEST(Measure, WithoutOcclusionNeitherSideShowsIt) {
  EXPECT_LT(error_of_cup(Occlusion::none, occluded_cup(Occlusion::occlusion)), 0.01);
}

TEST(Measure, LosingTheColoursOfTheOriginalIsAnError) {
  EXPECT_GT(measure(test::painted_model(test::cube()), test::plain_model(test::cube())).mean.mse1e4, 10);
}

TEST(Measure, OriginsAreRespected) {
  SourceModel original = test::painted_model(test::torus()), shifted = original;
  shifted.origin = {1, 2, 3};
  EXPECT_GT(measure(original, shifted).mean.mse1e4, 10);
  original.origin = shifted.origin;
  EXPECT_EQ(measure(original, shifted).mean.mse1e4, 0);
}

}  // namespace
}  // namespace vitrine
