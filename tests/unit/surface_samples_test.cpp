// SPDX-License-Identifier: Apache-2.0
#include "stages/surface_samples.h"

#include "stages/clean.h"
#include "stages/face_grid.h"
#include "tests/support/meshes.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace vitrine {
namespace {

SurfaceSamples samples_of(TriMesh mesh, std::size_t count) {
  return sample_surface(survey(std::make_shared<SourceModel const>(clean(test::plain_model(std::move(mesh))).model)),
                        count);
}

TEST(SurfaceSamples, FallByArea) {
  TriMesh mesh = test::grid(2, 1);
  for (V3f& p : mesh.positions)
    if (p.x == 2) p.x = 11;  // one square of width 1, one of width 10
  SurfaceSamples const samples = samples_of(mesh, 11'000);
  auto const small = std::ranges::count_if(samples.points, [](V3f const& p) { return p.x < 1; });
  EXPECT_NEAR(double(small), 1000, 2);
  EXPECT_FLOAT_EQ(samples.radius, std::sqrt(121.f + 1) / 2);
}

TEST(SurfaceSamples, LeaveNoLargeGapInAFace) {
  SurfaceSamples const samples = samples_of(test::grid(1, 1), 4000);
  for (float x = 0.05f; x < 1; x += 0.1f)
    for (float z = 0.05f; z < 1; z += 0.1f) {
      auto const near = std::ranges::count_if(
          samples.points, [&](V3f const& p) { return std::abs(p.x - x) < 0.05f && std::abs(p.z - z) < 0.05f; });
      EXPECT_NEAR(double(near), 40, 8) << x << ' ' << z;
    }
}

TEST(SurfaceSamples, CarryTheNormalsOfFacesAndOfShading) {
  SurfaceSamples const samples = samples_of(test::sphere(64, 32), 1000);
  for (std::size_t i = 0; i < samples.points.size(); ++i)
    EXPECT_GT(samples.shading[i].dot(samples.points[i].normalized()), 0.9995f);
  SurfaceSamples const cube = samples_of(test::cube(), 600);
  for (std::size_t i = 0; i < cube.points.size(); ++i)
    EXPECT_NEAR(cube.normals[i].dot(cube.points[i]), 0.5f, 1e-6f) << "of the face, not of the corners";
}

TEST(SurfaceSamples, FollowTheOutlineAsDenselyAsTheSurface) {
  SurfaceSamples const samples = samples_of(test::grid(10, 10), 10'000);  // a tenth apart
  EXPECT_NEAR(double(samples.outline.size()), 400, 2);
  for (V3f const& p : samples.outline) EXPECT_TRUE(p.x == 0 || p.x == 10 || p.z == 0 || p.z == 10) << p;
  EXPECT_TRUE(samples_of(test::sphere(), 1000).outline.empty());
}

TEST(SurfaceSamples, FollowSharpRidges) {
  SurfaceSamples const samples = samples_of(test::cube(), 60'000);  // a hundredth apart; 90 degrees count half
  EXPECT_NEAR(double(samples.ridges.size()), 600, 2);
  for (auto const& [point, along, normal] : samples.ridges) {
    EXPECT_NEAR(point.dot(normal), std::sqrt(0.5f), 1e-5f);
    EXPECT_NEAR(along.dot(normal), 0, 1e-6f);
  }
  EXPECT_TRUE(samples_of(test::sphere(), 1000).ridges.empty());
}

TEST(FaceGrid, TakesEdgesForFaces) {
  TriMesh const edges{{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}}, {{0, 1, 0}, {1, 2, 1}}};
  FaceGrid const grid(edges, 0.5f);
  auto const match = grid.closest({1.5f, 0.3f, 0.1f}, V3f(0));
  ASSERT_TRUE(match);
  EXPECT_EQ(match->face, 0u);
  EXPECT_FLOAT_EQ(match->at.u, 0.75f);
  EXPECT_FALSE(grid.closest({1, 1, 0}, V3f(0)));
}

TEST(FaceGrid, FindsWhatASearchThroughAllFacesFinds) {
  TriMesh mesh = test::bumpy_sphere(40, 20);
  TriMesh const slab = test::pierced_slab(2);
  for (Triangle const& t : slab.triangles) mesh.triangles.push_back({t[0] + 762, t[1] + 762, t[2] + 762});
  ASSERT_EQ(mesh.positions.size(), 762u);
  for (V3f const& p : slab.positions) mesh.positions.push_back(p * 0.3f + V3f(1, 0, 0));
  FaceGrid const grid(mesh, usual_reach(mesh));
  std::size_t found = 0;
  for (V3f const& from : mesh.positions)
    for (float out : {-0.9f, 0.1f, 0.6f, 2.f}) {
      V3f const side = V3f(from.y, from.x, 0.3f).normalized(),
                point = from + V3f(0.3f, 0.5f, -0.8f) * (out * grid.reach());
      float least = grid.reach();
      bool any = false;
      for (Triangle const& t : mesh.triangles) {
        V3f const a = mesh.positions[t[0]], b = mesh.positions[t[1]] - a, c = mesh.positions[t[2]] - a;
        Barycentric const at = closest_on_triangle(point - a, b, c);
        float const distance = (point - a - b * at.u - c * at.v).length();
        if (side.dot(b.cross(c)) > 0 && distance < least) least = distance, any = true;
      }
      auto const match = grid.closest(point, side);
      ASSERT_EQ(match.has_value(), any);
      if (!any) continue;
      ++found;
      Triangle const& t = mesh.triangles[match->face];
      V3f const at = interpolate(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]], match->at);
      EXPECT_NEAR((point - at).length(), least, 1e-5f);
    }
  EXPECT_GT(found, 500u);
}

}  // namespace
}  // namespace vitrine
