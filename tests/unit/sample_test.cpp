// SPDX-License-Identifier: Apache-2.0
#include "io/read_model.h"
#include "tests/support/folders.h"
#include "tools/sample/write.h"

#include <gmock/gmock.h>

#include <cmath>
#include <map>

namespace vitrine::sample {

void PrintTo(Object const& object, std::ostream* stream) { *stream << object.name; }
namespace {

constexpr std::uint64_t kSmall = 6000;

Scan small_scan(Object const& object, std::uint32_t seed = 1) { return scan(object.parts(seed), kSmall, seed); }

std::vector<Triangle> triangles(Scan const& scan) {
  std::vector<Triangle> all(scan.triangles);
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = triangle(scan, i);
  return all;
}

/// How often each directed edge is used without its opposite.
std::size_t open_edges(std::vector<Triangle> const& triangles) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
  for (Triangle const& t : triangles)
    for (int k = 0; k < 3; ++k) {
      std::uint32_t const a = t[k], b = t[(k + 1) % 3];
      balance[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  return std::size_t(std::count_if(balance.begin(), balance.end(), [](auto const& edge) { return edge.second != 0; }));
}

double volume(Scan const& scan, std::vector<Triangle> const& triangles) {
  double sum = 0;
  for (Triangle const& t : triangles)
    sum += V3d(scan.positions[t[0]]).dot(V3d(scan.positions[t[1]]).cross(V3d(scan.positions[t[2]]))) / 6;
  return sum;
}

TEST(Grid, WeldAndSplitAreInverse) {
  for (Topology const topology :
       {Topology::sheet, Topology::tube, Topology::cap, Topology::ball, Topology::torus, Topology::pillow}) {
    Grid const grid(topology, 60, 1.5);
    for (std::uint32_t i = 0; i < grid.vertices(); ++i) EXPECT_EQ(grid.weld(grid.split(i)), i);
    for (std::uint32_t i = 0; i < grid.split_vertices(); ++i) EXPECT_LT(grid.weld(i), grid.vertices());
  }
}

TEST(Grid, ClosedTopologiesHaveNoOpenEdgeAndOthersDo) {
  for (Topology const topology :
       {Topology::sheet, Topology::tube, Topology::cap, Topology::ball, Topology::torus, Topology::pillow}) {
    Grid const grid(topology, 60, 1.5);
    std::vector<Triangle> all;
    for (std::uint64_t i = 0; i < grid.triangles(); ++i) {
      Triangle t = grid.split_triangle(i);
      for (std::uint32_t& corner : t) corner = grid.weld(corner);
      all.push_back(t);
    }
    EXPECT_EQ(open_edges(all) == 0, closed(topology)) << int(topology);
  }
}

TEST(Grid, EulersNumberTellsBallFromTorus) {
  auto const euler = [](Grid const& grid) {
    return std::int64_t(grid.vertices()) - std::int64_t(grid.triangles()) / 2;
  };
  EXPECT_EQ(euler(Grid(Topology::ball, 200, 1)), 2);
  EXPECT_EQ(euler(Grid(Topology::pillow, 200, 1)), 2);
  EXPECT_EQ(euler(Grid(Topology::torus, 200, 1)), 0);
}

class EachObject : public testing::TestWithParam<Object> {};

TEST_P(EachObject, HasAboutTheTrianglesAskedFor) {
  EXPECT_NEAR(double(small_scan(GetParam()).triangles), double(kSmall), 0.2 * kSmall);
}

TEST_P(EachObject, IsFiniteAndFillsSomeSpace) {
  Scan const scanned = small_scan(GetParam());
  Box3f box;
  for (V3f const& p : scanned.positions) {
    ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
    box.extendBy(p);
  }
  EXPECT_GT(box.size().length(), 1);
}

TEST_P(EachObject, IsClosedWhereItSaysSoAndShowsItsOutside) {
  Scan const scanned = small_scan(GetParam());
  std::vector<Triangle> const all = triangles(scanned);
  EXPECT_EQ(open_edges(all) == 0, GetParam().closed);
  if (!GetParam().closed) return;
  for (PartGrid const& part : scanned.parts) {
    auto const from = all.begin() + std::ptrdiff_t(part.first_triangle);
    EXPECT_GT(volume(scanned, {from, from + std::ptrdiff_t(part.grid.triangles())}), 0);
  }
}

TEST_P(EachObject, IsTheSameForTheSameSeedAndAnotherForAnother) {
  EXPECT_EQ(small_scan(GetParam(), 3).positions, small_scan(GetParam(), 3).positions);
  EXPECT_NE(small_scan(GetParam(), 3).positions, small_scan(GetParam(), 4).positions);
}

TEST_P(EachObject, IsReadBackAsWritten) {
  test::TemporaryFolder const folder;
  Object const& object = GetParam();
  Scan const scanned = small_scan(object);
  auto const file = folder.path() / write(folder.path(), object, "object", scanned);
  SourceModel const model =
      io::read_model(ending(object.format), io::map_file(file), io::resolve_in(file.parent_path()));
  EXPECT_EQ(model.mesh.triangles.size(), scanned.triangles);
  EXPECT_EQ(has_colour(model), object.colour != Colour::none);
  Box3f box;
  for (V3f const& p : scanned.positions) box.extendBy(p);
  EXPECT_LT((bounds(model.mesh).center() - box.center()).length(), 1e-4f * box.size().length());
}

INSTANTIATE_TEST_SUITE_P(Sample, EachObject, testing::ValuesIn(objects().begin(), objects().end()),
                         [](auto const& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace vitrine::sample
