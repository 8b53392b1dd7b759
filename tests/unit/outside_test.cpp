// SPDX-License-Identifier: Apache-2.0
#include "stages/outside.h"

#include "tests/support/meshes.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <random>

namespace vitrine {
namespace {

/// Faces between vertices of the mesh that lie far apart: chords, where it is convex.
TriMesh with_chords(TriMesh mesh, std::size_t chords) {
  std::minstd_rand random;
  auto const any = [&] { return std::uint32_t(random() % mesh.positions.size()); };
  while (chords > 0) {
    Triangle const t{any(), any(), any()};
    V3f const a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]];
    if ((a - b).length() < 0.8f || (b - c).length() < 0.8f || (c - a).length() < 0.8f) continue;
    mesh.triangles.push_back(t);
    --chords;
  }
  return mesh;
}

TEST(Outside, OfATangleIsItsHull) {
  TriMesh const hull = test::sphere(12, 6);
  SourceModel model = test::plain_model(with_chords(hull, 4 * hull.triangles.size()));
  model.materials.resize(2);
  model.face_materials.assign(model.mesh.triangles.size(), 1);
  std::fill_n(model.face_materials.begin(), hull.triangles.size(), std::uint16_t{0});
  std::optional<SourceModel> const outer = outside(model);
  ASSERT_TRUE(outer);
  EXPECT_EQ(outer->mesh.triangles, hull.triangles);
  EXPECT_EQ(outer->mesh.positions, model.mesh.positions);
  EXPECT_THAT(outer->face_materials, testing::Each(0));
}

TEST(Outside, LeavesSurfacesAsTheyAre) {
  EXPECT_FALSE(outside(test::plain_model(test::torus())));
  EXPECT_FALSE(outside(test::plain_model(test::two_shells())));
}

TriMesh joined(TriMesh mesh, TriMesh const& more, V3f const& at, float size) {
  auto const first = std::uint32_t(mesh.positions.size());
  for (V3f const& p : more.positions) mesh.positions.push_back(p * size + at);
  for (auto const& [a, b, c] : more.triangles) mesh.triangles.push_back({first + a, first + b, first + c});
  return mesh;
}

TEST(Outside, OfAnAssemblyIsItsHousing) {
  TriMesh const ball = test::sphere(16, 8);
  TriMesh engine = ball;
  for (float x : {-0.3f, 0.0f, 0.3f}) engine = joined(engine, ball, {x, 0, 0}, 0.12f);
  std::optional<SourceModel> const outer = outside(test::plain_model(engine));
  ASSERT_TRUE(outer);
  EXPECT_EQ(outer->mesh.triangles, ball.triangles);
}

TEST(Outside, LeavesAnAssemblyOfWhichAllIsSeen) {
  TriMesh beads = test::sphere(16, 8);
  for (float x : {2.5f, 5.0f, 7.5f}) beads = joined(beads, test::sphere(16, 8), {x, 0, 0}, 1);
  EXPECT_FALSE(outside(test::plain_model(beads)));
}

TEST(Outside, LeavesATangleThatIsSeen) {
  TriMesh bare = test::sphere(5, 4);
  bare.triangles.clear();
  bare = with_chords(bare, 3 * bare.positions.size());
  EXPECT_FALSE(outside(test::plain_model(bare)));
}

}  // namespace
}  // namespace vitrine
