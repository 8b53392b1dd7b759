// SPDX-License-Identifier: Apache-2.0
#include "stages/deviation.h"

#include "stages/clean.h"
#include "tests/support/meshes.h"

#include <gmock/gmock.h>

#include <cmath>

namespace vitrine {
namespace {

SurfaceSamples samples_of(TriMesh const& mesh) {
  return sample_surface(survey(std::make_shared<SourceModel const>(clean(test::plain_model(mesh)).model)), 20'000);
}

TEST(Deviation, IsNothingOfAMeshFromItself) {
  TriMesh const cube = test::cube();
  EXPECT_LT(deviation(cube, samples_of(cube)), 1e-5);
}

TEST(Deviation, IsTheFarthestThatTheSurfaceWasLeft) {
  TriMesh moved = test::cube();
  for (V3f& p : moved.positions) p.x += 0.25f;
  EXPECT_NEAR(deviation(moved, samples_of(test::cube())), 0.25, 1e-3);
}

TEST(Deviation, OfNothingIsInfinite) { EXPECT_TRUE(std::isinf(deviation({}, samples_of(test::cube())))); }

TEST(PixelLength, ShrinksWithThePicturesSize) {
  double const at_200 = pixel_length(1, 200);
  EXPECT_NEAR(at_200, 2 / std::cos(std::acos(-1) / 12) / 200, 1e-6) << "the sphere just fits 30 degrees";
  EXPECT_NEAR(pixel_length(1, 400), at_200 / 2, 1e-12);
}

}  // namespace
}  // namespace vitrine
