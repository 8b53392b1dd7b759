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

TEST(Outside, LeavesATangleThatIsSeen) {
  TriMesh bare = test::sphere(5, 4);
  bare.triangles.clear();
  bare = with_chords(bare, 3 * bare.positions.size());
  EXPECT_FALSE(outside(test::plain_model(bare)));
}

}  // namespace
}  // namespace vitrine
