// SPDX-License-Identifier: Apache-2.0
#include "stages/judge.h"

#include "stages/clean.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vitrine {
namespace {

SurveyedModel sphere(int slices) {
  return survey(std::make_shared<SourceModel const>(clean(test::plain_model(test::sphere(slices, slices / 2))).model));
}

double cost(Difference const& mean) { return mean.mse1e4 * (1 - mean.foreground_ssim); }

/// Sum over the judges' settings, drawn for a screen of so many pixels.
double cost_at(std::vector<Judge> const& judges, int size, int supersample, SurveyedModel const& original,
               SurveyedModel const& thumbnail) {
  double sum = 0;
  for (Judge const& judge : judges) {
    MeasureOptions options = judge.reference.options;
    options.size = size, options.supersample = supersample;
    Reference const made = reference(original, options);
    sum += cost(compare(made.pictures, pictures(thumbnail, made)).mean);
  }
  return sum;
}

TEST(Judge, FindsNothingWrongWithTheOriginal) {
  SurveyedModel const original = sphere(32);
  Judgement const found = judgement(judges(original, 40, 2, Occlusion::none), original);
  EXPECT_EQ(found.mse1e4, 0);
  EXPECT_EQ(found.score, 0);
}

TEST(Judge, ScoresByTheGeometricMeanOfBothScreens) {
  SurveyedModel const original = sphere(64), thumbnail = sphere(12);
  std::vector<Judge> const both = judges(original, 40, 2, Occlusion::none);
  double const sharp = cost_at(both, 80, 2, original, thumbnail), coarse = cost_at(both, 40, 4, original, thumbnail);
  EXPECT_NEAR(judgement(both, thumbnail).score, std::sqrt(sharp * coarse), 0.01 * std::sqrt(sharp * coarse));
  EXPECT_GT(sharp, 1.1 * coarse);  // or the test could not tell them apart
}

TEST(Judge, LooksOnceWhereTheScreenIsCoarse) {
  SurveyedModel const original = sphere(64), thumbnail = sphere(12);
  std::vector<Judge> const one = judges(original, 40, 1, Occlusion::none);
  for (Judge const& judge : one) EXPECT_TRUE(judge.coarse.empty());
  EXPECT_DOUBLE_EQ(judgement(one, thumbnail).score, cost_at(one, 40, 2, original, thumbnail));
}

TEST(Judge, CanLeaveTheStructureOut) {
  SurveyedModel const original = sphere(64), thumbnail = sphere(12);
  std::vector<Judge> const one = judges(original, 40, 1, Occlusion::none);
  Judgement const found = judgement(one, thumbnail, false);
  EXPECT_DOUBLE_EQ(found.score, found.mse1e4 * double(one.size()));
}

}  // namespace
}  // namespace vitrine
