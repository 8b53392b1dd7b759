// SPDX-License-Identifier: Apache-2.0
#include "stages/segment.h"

#include <gmock/gmock.h>

#include <cmath>

#include "stages/straighten.h"
#include "tests/support/meshes.h"

namespace vitrine::test {
namespace {

using testing::IsEmpty;

TEST(Segment, OneTriangleIsOneChart) { EXPECT_EQ(segment(triangle()).charts, 1u); }

TEST(Segment, NoFaceNoChart) { EXPECT_EQ(segment(TriMesh{}).charts, 0u); }

TEST(Segment, AFlatGridStaysWhole) { EXPECT_EQ(segment(grid(8, 8)).charts, 1u); }

TEST(Segment, AConeUnrollsIntoFewCharts) { EXPECT_LE(segment(open_cone()).charts, 2u); }

TEST(Segment, ASphereFallsIntoAFewCharts) {
  std::uint32_t const charts = segment(sphere()).charts;
  EXPECT_GE(charts, 2u);
  EXPECT_LE(charts, 8u);
}

TEST(Segment, ACubeNeedsNoMoreChartsThanItHasSides) { EXPECT_LE(segment(cube()).charts, 6u); }

TEST(Segment, ShellsShareNoChart) {
  ChartedMesh const charts = segment(two_shells());
  std::vector<std::uint32_t> const left(charts.face_charts.begin(), charts.face_charts.begin() + 12);
  for (std::size_t f = 12; f < 24; ++f) EXPECT_THAT(left, testing::Not(testing::Contains(charts.face_charts[f])));
}

/// Three faces on one edge, the second and third of which continue the first.
TriMesh fork() {
  TriMesh mesh = non_manifold_edge();
  for (std::size_t f : {1, 2}) std::swap(mesh.triangles[f][1], mesh.triangles[f][2]);
  return mesh;
}

TEST(Segment, TwoOfThreeFacesAtAnEdgeBelongTogether) { EXPECT_EQ(segment(fork()).charts, 2u); }

TEST(Segment, FacesThatTurnOverAtAnEdgeDoNot) { EXPECT_EQ(segment(non_manifold_edge()).charts, 3u); }

TEST(Segment, AMoebiusStripIsCutAcross) {
  ChartedMesh const charts = segment(moebius());
  EXPECT_GE(charts.charts, 2u);
  EXPECT_THAT(check(charts), IsEmpty());
}

TEST(Segment, FaceOrderNumbersTheCharts) {
  ChartedMesh const charts = segment(sphere());
  std::uint32_t next = 0;
  for (std::uint32_t c : charts.face_charts) {
    EXPECT_LE(c, next);
    if (c == next) ++next;
  }
  EXPECT_EQ(next, charts.charts);
}

TEST(FaceAdjacency, PairsTheFlattestOfThreeFacesAtAnEdge) {
  TriMesh mesh = fork();
  mesh.positions[4] = {-1, 0, 0};  // in the plane of the first
  EXPECT_THAT(face_adjacency(mesh).across[0], testing::Contains(2u));
  mesh.positions[3] = {-1, 0, 0};
  mesh.positions[4] = {-1, 0, -1};
  EXPECT_THAT(face_adjacency(mesh).across[0], testing::Contains(1u));
}

TEST(GrowDisks, ClosesNoRing) {  // one seed on a torus: what would join the chart to itself becomes another
  TriMesh const mesh = torus(12, 8);
  std::vector<std::uint32_t> face_charts;
  std::uint32_t const charts = grow_disks(mesh, face_adjacency(mesh), std::array{0u},
                                          std::vector<double>(mesh.triangles.size(), 0.0), face_charts);
  EXPECT_GT(charts, 1u);
  EXPECT_THAT(check(ChartedMesh{mesh, face_charts, charts}), IsEmpty());
}

TEST(CutDisk, MakesDisks) {
  TriMesh const mesh = grid(9, 4);
  auto const parts = cut_disk(mesh);
  EXPECT_GE(parts.size(), 2u);
  for (auto const& part : parts) EXPECT_EQ(disk_defect(submesh(mesh, part).triangles), "");
}

TEST(Straighten, TakesTheToothOutOfASeam) {
  TriMesh const mesh = grid(4, 4);
  std::vector<std::uint32_t> straight;
  for (std::uint32_t f = 0; f < 32; ++f) straight.push_back(f / 2 % 4 < 2 ? 0 : 1);
  std::vector<std::uint32_t> face_charts = straight;
  face_charts[11] = 1;  // has two neighbours on the left
  straighten(mesh, face_adjacency(mesh), face_charts);
  EXPECT_EQ(face_charts, straight);
}

TEST(Straighten, TakesTheShortWayAroundAVertex) {  // a hexagon with one corner drawn out, and two faces around that
  float const h = std::sqrt(0.75f);
  TriMesh const mesh{{{0, 0, 0},
                      {1, 0, 0},
                      {1.5f, 3 * h, 0},
                      {-0.5f, h, 0},
                      {-1, 0, 0},
                      {-0.5f, -h, 0},
                      {0.5f, -h, 0},
                      {2.5f, 5 * h, 0}},
                     {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 6}, {0, 6, 1}, {2, 1, 7}, {3, 2, 7}}};
  std::vector<std::uint32_t> face_charts{0, 0, 0, 0, 0, 0, 1, 1};
  straighten(mesh, face_adjacency(mesh), face_charts);
  EXPECT_THAT(face_charts, testing::ElementsAre(1, 1, 0, 0, 0, 0, 1, 1));
}

}  // namespace
}  // namespace vitrine::test
