// SPDX-License-Identifier: Apache-2.0
#include "stages/crease.h"

#include "stages/clean.h"
#include "stages/paint.h"
#include "tests/support/meshes.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

namespace vitrine {
namespace {

constexpr int kSides = 32;

/// A can: round side, flat lids, the vertices of both rims twice.
SourceModel can() {
  SourceModel model;
  auto const add = [&](V3f const& position, V3f const& normal) {
    model.mesh.positions.push_back(position);
    model.normals.push_back(normal);
    return std::uint32_t(model.mesh.positions.size() - 1);
  };
  auto const around = [](int side) {
    float const angle = 2 * std::numbers::pi_v<float> * float(side % kSides) / kSides;
    return V3f(std::cos(angle), 0, -std::sin(angle));
  };
  V3f const up(0, 1, 0);
  std::uint32_t const above = add(up, up), below = add(-up, -up);
  for (int i = 0; i < kSides; ++i) {
    V3f const a = around(i), b = around(i + 1);
    std::uint32_t const foot = add(a - up, a), next = add(b - up, b), head = add(a + up, a), last = add(b + up, b);
    model.mesh.triangles.push_back({foot, next, last});
    model.mesh.triangles.push_back({foot, last, head});
    model.mesh.triangles.push_back({above, add(a + up, up), add(b + up, up)});
    model.mesh.triangles.push_back({below, add(b - up, -up), add(a - up, -up)});
  }
  return model;
}

SurveyedModel surveyed(SourceModel model) {
  return survey(std::make_shared<SourceModel const>(clean(std::move(model)).model));
}

TEST(Crease, IsWhereNormalsOfOnePlaceDiffer) {
  EXPECT_TRUE(has_creases(can()));
  EXPECT_FALSE(has_creases(clean(test::plain_model(test::cube())).model)) << "its normals were computed: all smooth";
}

TEST(Crease, IsNotWhereVerticesArePartedForAnotherReason) {
  SourceModel ball = clean(test::plain_model(test::sphere())).model;
  std::size_t const n = ball.mesh.positions.size();
  for (std::size_t v = 0; v < n; ++v) {  // as at the seam of a texture
    ball.mesh.positions.push_back(ball.mesh.positions[v]);
    ball.normals.push_back(ball.normals[v]);
  }
  EXPECT_FALSE(has_creases(ball));
}

TEST(Crease, PartsTheRimsOfACanAndNothingElse) {
  SurveyedModel const original = surveyed(can());
  SurfaceSamples const samples = sample_surface(original, 20'000);
  EXPECT_TRUE(samples.creased);
  TriMesh const light = weld(*original.model);
  ASSERT_EQ(light.positions.size(), 2u * kSides + 2);
  PartedMesh const parted = part_at_creases(light, samples);
  EXPECT_EQ(parted.mesh.positions.size(), 4u * kSides + 2);
  ASSERT_EQ(parted.mesh.triangles.size(), light.triangles.size());
  for (std::size_t f = 0; f < light.triangles.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      std::uint32_t const v = parted.mesh.triangles[f][k];
      EXPECT_EQ(parted.whole[v], light.triangles[f][k]);
      EXPECT_EQ(parted.mesh.positions[v], light.positions[light.triangles[f][k]]);
    }
}

TEST(Crease, ABallStaysWhole) {
  TriMesh const light = test::sphere(16, 8);
  SurfaceSamples const samples = sample_surface(surveyed(test::plain_model(test::sphere())), 20'000);
  EXPECT_FALSE(samples.creased);
  EXPECT_EQ(part_at_creases(light, samples).mesh.positions.size(), light.positions.size());
}

/// Largest angle between what corners store and what the original's faces there show, in degrees.
double worst_angle(BakedModel const& model) {
  double worst = 0;
  for (auto const& [a, b, c] : model.mesh.triangles)
    for (std::uint32_t v : {a, b, c}) {
      V3f const face = (model.mesh.positions[b] - model.mesh.positions[a])
                           .cross(model.mesh.positions[c] - model.mesh.positions[a])
                           .normalized();
      V3f const place = model.mesh.positions[v];
      V3f const shown = std::abs(face.y) > 0.5f ? V3f(0, face.y, 0) : V3f(place.x, 0, place.z);
      double const cosine = double(shown.normalized().dot(model.normals[v]));
      worst = std::max(worst, std::acos(std::min(cosine, 1.0)) * 180 / std::numbers::pi);
    }
  return worst;
}

TEST(Crease, NormalsOnBothSidesAreTheOriginals) {
  SurveyedModel const original = surveyed(can());
  SurfaceSamples const samples = sample_surface(original, 50'000);
  TriMesh const light = weld(*original.model);
  QuantizedMesh const placed = quantize(light, cube_about(light, 14));
  BakedModel const parted = paint(placed, original, samples, {.normals = true, .creases = true, .normal_bits = 10});
  EXPECT_LT(worst_angle(parted), 3);
  EXPECT_GT(worst_angle(paint(placed, original, samples, {.normals = true, .normal_bits = 10})), 25)
      << "one normal cannot serve both sides";
}

TEST(Crease, ColoursStayWithTheirPlaces) {
  SourceModel coloured = can();
  for (V3f const& p : coloured.mesh.positions) {
    auto const part = [](float x) { return std::uint16_t(65535 * (0.5f + 0.4f * x)); };
    coloured.colours.push_back({part(p.x), part(p.y), part(p.z), 65535});
  }
  SurveyedModel const original = surveyed(std::move(coloured));
  SurfaceSamples const samples = sample_surface(original, 20'000);
  TriMesh const light = weld(*original.model);
  QuantizedMesh const placed = quantize(light, cube_about(light, 14));
  BakedModel const model = paint(placed, original, samples, {.palette = false, .normals = true, .creases = true});
  ASSERT_EQ(model.colours.size(), model.mesh.positions.size());
  ASSERT_GT(model.mesh.positions.size(), light.positions.size());
  for (std::size_t v = 0; v < model.colours.size(); ++v) {
    auto const same = std::ranges::find(model.mesh.positions, model.mesh.positions[v]) - model.mesh.positions.begin();
    EXPECT_EQ(model.colours[v], model.colours[std::size_t(same)]);
  }
}

}  // namespace
}  // namespace vitrine
