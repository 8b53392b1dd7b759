// SPDX-License-Identifier: Apache-2.0
#include "stages/depth_buffer.h"

#include "stages/ray_scene.h"
#include "tests/support/meshes.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numeric>
#include <utility>

namespace vitrine {
namespace {

constexpr int kSide = 64;

Lens lens(V3d const& direction = {0, 0, 1}) {
  return {camera({{0, 0, 0}, 1}, direction.normalized()), {0, 0, 0}, kSide};
}

/// Two squares of edge 1 about the z axis, the second at a depth of its own.
TriMesh squares(float z) {
  TriMesh mesh;
  for (float at : {0.f, z}) {
    std::uint32_t const first = std::uint32_t(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {{-.5f, -.5f, at}, {.5f, -.5f, at}, {.5f, .5f, at}, {-.5f, .5f, at}});
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
  }
  return mesh;
}

std::uint32_t middle_face(TriMesh const& mesh) {
  DepthBuffer buffer(kSide);
  EXPECT_TRUE(buffer.draw(mesh, lens()));
  return buffer.face(kSide / 2 + 2, kSide / 2);
}

TEST(DepthBuffer, TheNearerFaceIsSeen) {
  EXPECT_LT(middle_face(squares(-.1f)), 2u);
  EXPECT_GE(middle_face(squares(.1f)), 2u);
}

TEST(DepthBuffer, OfFacesAtOneDepthTheLastIsSeen) { EXPECT_GE(middle_face(squares(0)), 2u); }

TEST(DepthBuffer, NothingIsSeenBesideTheObject) {
  DepthBuffer buffer(kSide);
  ASSERT_TRUE(buffer.draw(squares(0), lens()));
  EXPECT_EQ(buffer.face(2, kSide / 2), DepthBuffer::kNothing);
  EXPECT_EQ(buffer.face(kSide / 2, 2), DepthBuffer::kNothing);
}

TEST(DepthBuffer, TheLastDrawingIsForgotten) {
  DepthBuffer buffer(kSide);
  ASSERT_TRUE(buffer.draw(test::sphere(), lens()));
  ASSERT_TRUE(buffer.draw(test::triangle(), lens()));
  int seen = 0;
  for (int i = 0; i < kSide * kSide; ++i) seen += buffer.face(i % kSide, i / kSide) != DepthBuffer::kNothing;
  EXPECT_LT(seen, kSide * kSide / 2);
}

TEST(DepthBuffer, WhatWouldHaveToBeClippedIsNotDrawn) {
  DepthBuffer buffer(kSide);
  EXPECT_FALSE(buffer.draw(squares(2), lens())) << "before the near plane";
  EXPECT_FALSE(buffer.draw(squares(-3), lens())) << "behind the far plane";
  EXPECT_FALSE(buffer.draw(squares(100), lens())) << "behind the eye";
  TriMesh wide = squares(0);
  wide.positions[0].x = 1e9f;
  EXPECT_FALSE(buffer.draw(wide, lens()));
  wide.positions[0].x = std::nanf("");
  EXPECT_FALSE(buffer.draw(wide, lens()));
}

/// Share of the samples at which rays see another face; of those, which a ray a hundredth of a sample beside sees too,
/// do not count.
double disagreement(TriMesh const& mesh, Lens const& from) {
  DepthBuffer buffer(kSide);
  EXPECT_TRUE(buffer.draw(mesh, from));
  RayScene const rays(mesh);
  auto const seen = [&](float column, float row) {
    auto const hit = rays.first_hit({from.eye, from.direction(column, row), from.near, from.far});
    return hit ? hit->face : DepthBuffer::kNothing;
  };
  int apart = 0;
  for (int row = 0; row < kSide; ++row)
    for (int column = 0; column < kSide; ++column) {
      bool same = false;
      for (auto const& [dx, dy] : {std::pair{0.f, 0.f}, {.01f, 0.f}, {-.01f, 0.f}, {0.f, .01f}, {0.f, -.01f}})
        same = same || seen(float(column) + dx, float(row) + dy) == buffer.face(column, row);
      apart += !same;
    }
  return double(apart) / (kSide * kSide);
}

TEST(DepthBuffer, SeesWhatRaysSee) {
  for (V3d const& direction : directions(ViewSet::sphere, 6)) {
    EXPECT_EQ(disagreement(test::cube({.1f, .2f, 0}), lens(direction)), 0);
    EXPECT_LT(disagreement(test::torus(32, 16, .7f, .25f), lens(direction)), 1e-3);
    EXPECT_LT(disagreement(test::bumpy_sphere(400, 200), lens(direction)), 3e-3);  // faces smaller than samples
  }
}

}  // namespace
}  // namespace vitrine
