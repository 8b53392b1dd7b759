// SPDX-License-Identifier: Apache-2.0
#include "stages/measure.h"

#include "stages/clean.h"
#include "tests/support/meshes.h"

#include <gmock/gmock.h>

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
