// SPDX-License-Identifier: Apache-2.0
#include "stages/edges.h"

#include "tests/support/meshes.h"

#include <gmock/gmock.h>

namespace vitrine {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

TEST(Outline, OfClosedMeshesIsEmpty) {
  for (TriMesh const& mesh : {test::cube(), test::torus(), test::pierced_slab(2)}) {
    EXPECT_THAT(outline(mesh).open, IsEmpty());
    EXPECT_THAT(outline(mesh).tangled, IsEmpty());
  }
}

TEST(Outline, RunsAlongTheEdgesOfOneFace) {
  TriMesh const grid = test::grid(5, 3);
  Outline const found = outline(grid);
  EXPECT_THAT(found.open, SizeIs(2 * (5 + 3)));
  EXPECT_THAT(found.tangled, IsEmpty());
  for (auto const& [face, corner] : found.open) {
    V3f const a = grid.positions[grid.triangles[face][corner]],
              b = grid.positions[grid.triangles[face][(corner + 1) % 3]];
    V3f const middle = (a + b) / 2;
    EXPECT_TRUE(middle.x == 0 || middle.x == 5 || middle.z == 0 || middle.z == 3) << middle;
  }
}

TEST(Outline, TellsEdgesOfThreeFaces) {
  Outline const found = outline(test::non_manifold_edge());
  EXPECT_THAT(found.open, SizeIs(6));
  EXPECT_THAT(found.tangled, SizeIs(3));
}

}  // namespace
}  // namespace vitrine
