// SPDX-License-Identifier: Apache-2.0
#include "stages/view.h"

#include "stages/error.h"
#include "tests/support/meshes.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

namespace vitrine {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

TEST(View, TheTurntableStartsInFrontAndTurnsTowardsX) {
  std::vector<V3d> const around = directions(ViewSet::turntable, 4);
  ASSERT_EQ(around.size(), 4u);
  EXPECT_NEAR(around[0].z, std::cos(10 * kDegree), 1e-15);
  EXPECT_NEAR(around[1].x, std::cos(10 * kDegree), 1e-15);
  for (V3d const& d : around) EXPECT_NEAR(d.y, std::sin(10 * kDegree), 1e-15);
}

TEST(View, DirectionsAreUnitVectors) {
  for (ViewSet set : {ViewSet::turntable, ViewSet::sphere})
    for (V3d const& d : directions(set, 24)) EXPECT_NEAR(d.length(), 1, 1e-15);
}

TEST(View, TheSphereIsSeenFromAllSidesAlike) {
  V3d sum(0);
  for (V3d const& d : directions(ViewSet::sphere, 24)) sum += d;
  EXPECT_LT(sum.length(), 0.3);
}

TEST(View, TheBoundingSphereTouchesTheCorners) {
  BoundingSphere const sphere = bounding_sphere(test::plain_model(test::cube({1, 2, 3}, 2)));
  EXPECT_NEAR((sphere.centre - V3d(1, 2, 3)).length(), 0, 1e-6);
  EXPECT_NEAR(sphere.radius, std::sqrt(3.0), 1e-6);
}

TEST(View, UnusedVerticesDoNotCount) {
  SourceModel model = test::plain_model(test::cube());
  model.mesh.positions.push_back({100, 0, 0});
  EXPECT_NEAR(bounding_sphere(model).radius, std::sqrt(0.75), 1e-6);
}

TEST(View, TheOriginIsAddedToTheCentre) {
  SourceModel model = test::plain_model(test::cube());
  model.origin = {1e7, 0, 0};
  EXPECT_EQ(bounding_sphere(model).centre, V3d(1e7, 0, 0));
}

TEST(View, AModelInOnePlaceHasNoCamera) {
  SourceModel model = test::plain_model(test::triangle());
  model.mesh.positions.assign(3, V3f(1));
  EXPECT_THROW(bounding_sphere(model), Error);
  EXPECT_THROW(bounding_sphere(SourceModel{}), Error);
}

TEST(View, TheSphereJustFitsThePicture) {
  BoundingSphere const sphere{{1, 2, 3}, 2};
  for (V3d const& direction : directions(ViewSet::sphere, 8)) {
    Camera const c = camera(sphere, direction);
    V3d const edge = through(c, 0, 1).normalized(), to_centre = sphere.centre - c.eye;
    EXPECT_NEAR(to_centre.cross(edge).length(), sphere.radius, 1e-12);
    EXPECT_NEAR(to_centre.dot(c.forward), to_centre.length(), 1e-12);
  }
}

TEST(View, AxesAreRightHandedAndUpright) {
  for (V3d const& direction : directions(ViewSet::sphere, 8)) {
    Camera const c = camera({{0, 0, 0}, 1}, direction);
    EXPECT_NEAR((c.right.cross(c.up) + c.forward).length(), 0, 1e-12);
    EXPECT_NEAR(c.right.y, 0, 1e-12);
    EXPECT_GT(c.up.y, 0);
  }
}

}  // namespace
}  // namespace vitrine
