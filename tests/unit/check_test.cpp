// SPDX-License-Identifier: Apache-2.0
// The checks pass what is valid and see each single fault.
#include <gmock/gmock.h>

#include <limits>

#include "stages/chart_topology.h"
#include "stages/pack.h"
#include "stages/parameterize.h"
#include "stages/segment.h"
#include "tests/support/meshes.h"

namespace vitrine::test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

ChartedMesh one_chart(TriMesh mesh) {
  ChartedMesh charts{std::move(mesh), {}, 1};
  charts.face_charts.assign(charts.mesh.triangles.size(), 0);
  return charts;
}

TriMesh ring() {  // the sides of a cube
  TriMesh mesh = cube();
  mesh.triangles.erase(mesh.triangles.begin(), mesh.triangles.begin() + 4);
  return mesh;
}

TEST(CheckMesh, PassesACube) { EXPECT_THAT(check(cube()), IsEmpty()); }

TEST(CheckMesh, SeesAVertexThatIsNotThere) {
  TriMesh mesh = cube();
  mesh.triangles[3][1] = 8;
  EXPECT_THAT(check(mesh), testing::ElementsAre("face 3: vertex 8 of 8"));
}

TEST(CheckMesh, SeesAPlaceThatIsNoNumber) {
  TriMesh mesh = cube();
  mesh.positions[2].y = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(check(mesh), testing::ElementsAre("vertex 2 is not finite"));
}

TEST(CheckMesh, SeesAVertexUsedTwiceByAFace) {
  TriMesh mesh = triangle();
  mesh.triangles[0] = {0, 1, 1};
  EXPECT_THAT(check(mesh), testing::ElementsAre("face 0 uses a vertex twice"));
}

TEST(CheckSource, PassesPlainAndPaintedModels) {
  EXPECT_THAT(check(plain_model(cube())), IsEmpty());
  EXPECT_THAT(check(painted_model(cube())), IsEmpty());
}

TEST(CheckSource, SeesAnArrayOfTheWrongLength) {
  SourceModel model = painted_model(cube());
  model.colours.pop_back();
  EXPECT_THAT(check(model), testing::ElementsAre("colours: 7 of them, 8 wanted"));
}

TEST(CheckSource, SeesMaterialsAndImagesThatAreNotThere) {
  SourceModel model = plain_model(triangle());
  model.face_materials = {1};
  model.materials[0].colour_map.image = 0;
  EXPECT_THAT(check(model), testing::ElementsAre("face 0: material 1 of 1", "material 0: image 0 of 0"));
}

TEST(CheckSource, SeesAnImageWithoutItsTexels) {
  SourceModel model = plain_model(triangle());
  model.images.push_back({.width = 2, .height = 2, .channels = 3, .texels = std::vector<std::uint8_t>(11)});
  EXPECT_THAT(check(model), testing::ElementsAre("image 0: its texels do not match its size"));
}

TEST(CheckSource, SeesANormalThatIsNotOfLengthOne) {
  SourceModel model = plain_model(triangle());
  model.normals = {{0, 0, 1}, {0, 0, 2}, {0, 0, 1}};
  EXPECT_THAT(check(model), testing::ElementsAre("normal 1 is not of length 1"));
}

TEST(DiskDefect, NamesWhatIsWrong) {
  EXPECT_EQ(disk_defect(grid(3, 2).triangles), "");
  EXPECT_EQ(disk_defect(ring().triangles), "has Euler characteristic 0, a disk has 1");
  EXPECT_EQ(disk_defect(cube().triangles), "has Euler characteristic 2, a disk has 1");
  EXPECT_EQ(disk_defect(two_shells().triangles), "falls into 2 pieces");
  EXPECT_EQ(disk_defect(std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {4, 3, 0}}),
            "touches itself at a vertex");
  EXPECT_EQ(disk_defect(std::vector<Triangle>{{0, 1, 2}, {0, 1, 3}}), "turns over at edge 0-1");
  EXPECT_EQ(disk_defect(non_manifold_edge().triangles), "has 3 faces at edge 0-1");
}

TEST(CheckCharts, SeesAnAnnulus) {
  EXPECT_THAT(check(one_chart(ring())), testing::ElementsAre("chart 0 has Euler characteristic 0, a disk has 1"));
}

TEST(CheckCharts, SeesAFaceWithoutAChartAndAChartWithoutAFace) {
  ChartedMesh charts = one_chart(grid(2, 1));
  charts.charts = 2;
  charts.face_charts[0] = 2;
  EXPECT_THAT(check(charts), testing::ElementsAre("face 0: chart 2 of 2", "chart 1 has no face"));
}

TEST(CheckFlat, PassesWhatParameterizeMakes) { EXPECT_THAT(check(parameterize(one_chart(grid(3, 3)))), IsEmpty()); }

TEST(CheckFlat, SeesAFlippedTriangle) {
  FlatCharts flat = parameterize(one_chart(triangle()));
  std::swap(flat.corner_uvs[0][0], flat.corner_uvs[0][1]);
  EXPECT_THAT(check(flat), Contains("face 0 is flipped in chart 0"));
}

TEST(CheckFlat, SeesAnOverlap) {  // a fan of six right angles winds one and a half times around its apex
  FlatCharts flat;
  flat.charts = 1;
  flat.stretch = {1};
  flat.face_charts.assign(6, 0);
  constexpr std::array<std::array<float, 2>, 4> kAround{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  flat.mesh.positions.push_back({0, 0, 0});
  for (std::uint32_t i = 0; i < 7; ++i) flat.mesh.positions.push_back({kAround[i % 4][0], kAround[i % 4][1], 0});
  for (std::uint32_t i = 0; i < 6; ++i) {
    auto const [ax, ay] = kAround[i % 4];
    auto const [bx, by] = kAround[(i + 1) % 4];
    flat.mesh.triangles.push_back({0, i + 1, i + 2});
    flat.corner_uvs.push_back({V2f(0, 0), V2f(ax, -ay), V2f(bx, -by)});
  }
  EXPECT_THAT(check(flat),
              testing::UnorderedElementsAre("faces 0 and 4 overlap in chart 0", "faces 1 and 5 overlap in chart 0"));
}

TEST(CheckFlat, SeesAVertexAtTwoPlaces) {
  FlatCharts flat = parameterize(one_chart(grid(1, 1)));
  flat.corner_uvs[1][0].x += 0.1f;
  EXPECT_THAT(check(flat), Contains(HasSubstr("two places in chart 0")));
}

TEST(CheckFlat, SeesAChartThatShrank) {
  FlatCharts flat = parameterize(one_chart(grid(1, 1)));
  for (CornerUvs& uvs : flat.corner_uvs)
    for (V2f& uv : uvs) uv *= 0.9f;
  EXPECT_THAT(check(flat), testing::ElementsAre(HasSubstr("chart 0: area 0.81")));
}

Atlas two_squares() {
  FlatCharts const flat = parameterize(segment(two_shells()));
  return pack(flat, {.texture = 64, .gutter = 2});
}

TEST(CheckAtlas, PassesWhatPackMakes) { EXPECT_THAT(check(two_squares()), IsEmpty()); }

TEST(CheckAtlas, SeesChartsInTheSameTexel) {
  Atlas atlas = two_squares();
  auto const other = std::ranges::find_if(atlas.face_charts, [&](auto c) { return c != atlas.face_charts[0]; });
  V2f const move = atlas.corner_uvs[0][0] - atlas.corner_uvs[std::size_t(other - atlas.face_charts.begin())][0];
  for (std::size_t f = 0; f < atlas.face_charts.size(); ++f)
    if (atlas.face_charts[f] == *other)
      for (V2f& uv : atlas.corner_uvs[f])
        uv = {std::clamp(uv.x + move.x, 0.f, 1.f), std::clamp(uv.y + move.y, 0.f, 1.f)};
  EXPECT_THAT(check(atlas), Contains(HasSubstr("share texel")));
}

TEST(CheckAtlas, SeesAGutterThatIsTooNarrow) {
  Atlas atlas = two_squares();
  atlas.gutter = 12;
  EXPECT_THAT(check(atlas), Contains(HasSubstr("keep no gutter")));
  EXPECT_THAT(check(atlas), Contains(HasSubstr("lies in the border")));
}

TEST(CheckAtlas, SeesCoordinatesOutsideTheTexture) {
  Atlas atlas = two_squares();
  atlas.corner_uvs[0][0].x = 1.01f;
  EXPECT_THAT(check(atlas), Contains("face 0 reaches out of the texture"));
}

}  // namespace
}  // namespace vitrine::test
