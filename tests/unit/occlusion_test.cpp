// SPDX-License-Identifier: Apache-2.0
#include "stages/occlusion.h"

#include "stages/clean.h"
#include "stages/surface.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vitrine {
namespace {

SurveyedModel surveyed(SourceModel model, int rays) {
  return survey(std::make_shared<SourceModel const>(std::move(model)), rays);
}

SurveyedModel smooth(TriMesh mesh, int rays) { return surveyed(clean(test::plain_model(std::move(mesh))).model, rays); }

/// Rows x columns of quads from `corner` along two edges, facing across x along.
void add_wall(TriMesh& mesh, V3f const& corner, V3f const& across, V3f const& along, std::uint32_t n) {
  std::uint32_t const first = std::uint32_t(mesh.positions.size());
  for (std::uint32_t j = 0; j <= n; ++j)
    for (std::uint32_t i = 0; i <= n; ++i)
      mesh.positions.push_back(corner + across * (float(i) / float(n)) + along * (float(j) / float(n)));
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      std::uint32_t const a = first + j * (n + 1) + i, b = a + n + 1;
      mesh.triangles.push_back({a, a + 1, b + 1});
      mesh.triangles.push_back({a, b + 1, b});
    }
}

/// A floor, facing +Z, and a wall on its edge at x = 0, facing +X, of n x n quads each, with flat normals.
SourceModel corner_of_a_room(std::uint32_t n) {
  SourceModel room;
  add_wall(room.mesh, {0, -4, 0}, {4, 0, 0}, {0, 8, 0}, n);
  room.normals.assign(room.mesh.positions.size(), {0, 0, 1});
  add_wall(room.mesh, {0, -4, 0}, {0, 8, 0}, {0, 0, 4}, n);
  room.normals.resize(room.mesh.positions.size(), {1, 0, 0});
  return room;
}

/// The floor in the middle of the wall, `x` away from it.
float on_the_floor(SurveyedModel const& room, float x) {
  auto const hit = room.scene.first_hit({{x, 0.01f, 1}, {0, 0, -1}});
  return room.occlusion->at(room.model->mesh, *hit);
}

/// What the wall leaves: one less the form factor of a rectangle that stands on the plane. Howell, "Radiation
/// Configuration Factors", B-4.
float beside_the_wall(float x) {
  float const top = std::hypot(x, 4.f);
  return 1 - (std::atan(4 / x) - x / top * std::atan(4 / top)) / std::numbers::pi_v<float>;
}

TEST(Occlusion, AConvexSolidIsInTheOpen) {
  SurveyedModel const ball = smooth(test::sphere(64, 32), 64);
  for (std::uint32_t face = 0; face < ball.model->mesh.triangles.size(); ++face)
    EXPECT_GT(ball.occlusion->at(ball.model->mesh, {face, 0.3f, 0.3f}), 0.96f);
}

TEST(Occlusion, OnlyModelsWithoutColourAreTraced) {
  EXPECT_FALSE(survey(std::make_shared<SourceModel const>(test::painted_model(test::cube())), 64).occlusion);
  EXPECT_FALSE(survey(std::make_shared<SourceModel const>(test::plain_model(test::cube()))).occlusion);
}

TEST(Occlusion, AWallDarkensTheFloorBesideItInLargeFacesAndInSmallOnes) {
  for (std::uint32_t n : {1u, 100u}) {
    SurveyedModel const room = surveyed(corner_of_a_room(n), 128);
    for (float x : {0.3f, 1.f, 2.f})
      EXPECT_NEAR(on_the_floor(room, x), beside_the_wall(x), 0.03f) << n << " quads, " << x << " from the wall";
  }
}

TEST(Occlusion, InsideAClosedBoxItIsDark) {
  TriMesh box = test::cube();
  for (Triangle& t : box.triangles) std::swap(t[1], t[2]);
  SurveyedModel const closed = smooth(box, 64);
  EXPECT_EQ(closed.occlusion->at(closed.model->mesh, {0, 0.3f, 0.3f}), 0);
}

TEST(Occlusion, ThreadsDoNotChangeABit) {
  auto const values = [] {
    SurveyedModel const ring = smooth(test::torus(60, 30), 4);
    std::vector<float> all;
    for (std::uint32_t face = 0; face < ring.model->mesh.triangles.size(); ++face)
      all.push_back(ring.occlusion->at(ring.model->mesh, {face, 0.2f, 0.4f}));
    return all;
  };
  std::vector<float> const many = values();
  tbb::global_control const one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(many, values());
}

}  // namespace
}  // namespace vitrine
