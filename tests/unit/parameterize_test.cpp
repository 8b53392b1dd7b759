// SPDX-License-Identifier: Apache-2.0
#include "stages/parameterize.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "stages/error.h"
#include "stages/flatten.h"
#include "tests/support/meshes.h"

namespace vitrine::test {
namespace {

using testing::IsEmpty;

ChartedMesh one_chart(TriMesh mesh) {
  ChartedMesh charts{std::move(mesh), {}, 1};
  charts.face_charts.assign(charts.mesh.triangles.size(), 0);
  return charts;
}

/// A grid bent around the z axis by `angle` in all: isometric to the grid.
TriMesh bent_grid(int columns, int rows, float angle) {
  TriMesh mesh = grid(columns, rows);
  float const radius = float(columns) / angle;
  for (V3f& p : mesh.positions) p = {radius * std::sin(p.x / radius), radius * std::cos(p.x / radius), p.z};
  return mesh;
}

TEST(Parameterize, KeepsTheSidesOfATriangle) {
  CornerUvs const uv = parameterize(one_chart(triangle())).corner_uvs[0];
  EXPECT_NEAR((uv[1] - uv[0]).length(), 1, 1e-6);
  EXPECT_NEAR((uv[2] - uv[0]).length(), 1, 1e-6);
  EXPECT_NEAR((uv[2] - uv[1]).length(), std::numbers::sqrt2, 1e-6);
}

TEST(Parameterize, DoesNotMirrorTheImage) {  // v points down, so that counter-clockwise is a negative cross product
  CornerUvs const uv = parameterize(one_chart(triangle())).corner_uvs[0];
  EXPECT_LT((uv[1] - uv[0]).cross(uv[2] - uv[0]), 0);
}

TEST(Parameterize, AFlatChartIsCongruent) {
  FlatCharts const flat = parameterize(one_chart(grid(5, 3)));
  EXPECT_NEAR(flat.stretch[0], 1, 1e-5);
  EXPECT_EQ(flat.retries, 0u);
  for (std::size_t f = 0; f < flat.corner_uvs.size(); ++f)
    for (std::size_t i = 0; i < 3; ++i) {
      auto const& t = flat.mesh.triangles[f];
      float const in_space = (flat.mesh.positions[t[i]] - flat.mesh.positions[t[(i + 1) % 3]]).length();
      EXPECT_NEAR((flat.corner_uvs[f][i] - flat.corner_uvs[f][(i + 1) % 3]).length(), in_space, 1e-5);
    }
}

TEST(Parameterize, UnrollsAHalfCylinder) {
  FlatCharts const flat = parameterize(one_chart(bent_grid(24, 4, std::numbers::pi_v<float>)));
  EXPECT_EQ(flat.charts, 1u);
  EXPECT_NEAR(flat.stretch[0], 1, 2e-3);
}

TEST(Parameterize, SplitsARollThatWouldCoverItself) {  // a helical ramp of two turns around an axis overlaps when flat
  TriMesh ramp = grid(64, 2);
  for (V3f& p : ramp.positions) {
    float const turn = p.x / 64 * 4 * std::numbers::pi_v<float>, radius = 1 + p.z;
    p = {radius * std::cos(turn), 0.02f * p.x, radius * std::sin(turn)};
  }
  FlatCharts const flat = parameterize(one_chart(ramp));
  EXPECT_GE(flat.charts, 2u);
  EXPECT_GE(flat.retries, 1u);
  EXPECT_THAT(check(flat), IsEmpty());
}

TEST(Parameterize, SplitsADomeThatStarvesOfTexels) {  // a sphere without one face has to be one disk
  TriMesh ball = sphere(16, 8);
  ball.triangles.pop_back();
  FlatCharts const flat = parameterize(one_chart(ball));
  EXPECT_GE(flat.charts, 2u);
  EXPECT_THAT(check(flat), IsEmpty());
}

TEST(Parameterize, ASliverLiesFlat) { EXPECT_THAT(check(parameterize(one_chart(sliver()))), IsEmpty()); }

TEST(Parameterize, FacesWithoutAreaDoNoHarm) {
  TriMesh mesh = grid(2, 1);
  mesh.positions[1] = mesh.positions[0];  // two faces collapse
  EXPECT_THAT(check(parameterize(one_chart(mesh))), IsEmpty());
}

TEST(Parameterize, AChartWithoutExtentStaysFinite) {
  TriMesh const dot{{{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}, {{0, 1, 2}}};
  EXPECT_THAT(check(parameterize(one_chart(dot))), IsEmpty());
}

TEST(Parameterize, RefusesWhatIsNoDisk) {
  try {
    parameterize(one_chart(cube()));
    FAIL();
  } catch (Error const& error) {
    EXPECT_EQ(error.kind(), ErrorKind::invalid_input);
    EXPECT_STREQ(error.what(), "chart 0 is not a disk: it has Euler characteristic 2, a disk has 1");
  }
}

TriMesh hemisphere() {
  TriMesh cap = sphere(32, 16);
  cap.triangles.resize(32 + 7 * 64);
  cap.positions.resize(1 + 8 * 32);
  return cap;
}

double area(CornerUvs const& uv) { return std::abs((uv[1] - uv[0]).cross(uv[2] - uv[0])) / 2; }

TEST(Parameterize, RelaxingBringsTheStretchDown) {
  TriMesh const cap = hemisphere();
  FlatCharts const rigid = parameterize(one_chart(cap), std::vector<float>(cap.triangles.size(), 1));
  EXPECT_LT(rigid.stretch[0], parameterize(one_chart(cap)).stretch[0] - 0.01);
  EXPECT_THAT(check(rigid), IsEmpty());
}

TEST(Parameterize, FacesGetTheLengthsThatAreAskedFor) {
  TriMesh const sheet = grid(16, 4);
  std::vector<float> lengths;
  for (Triangle const& t : sheet.triangles) lengths.push_back(sheet.positions[t[0]].x < 8 ? 1.f : 1.5f);
  FlatCharts const flat = parameterize(one_chart(sheet), lengths);
  double small = 0, large = 0;
  for (std::size_t f = 0; f < lengths.size(); ++f) (lengths[f] > 1 ? large : small) += area(flat.corner_uvs[f]);
  EXPECT_NEAR(small + large, 32 + 1.5 * 1.5 * 32, 1e-2);
  EXPECT_GT(large / small, 1.7);
}

TEST(Flatten, NoticesAFold) {  // a spike: three steep faces around a tip
  TriMesh const spike{{{0, 40, 0}, {1, 0, 0}, {-0.5f, 0, 0.9f}, {-0.5f, 0, -0.9f}}, {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}}};
  FlatDisk const flat = flatten(spike);
  EXPECT_FALSE(lies_flat(flat, kBearable));
  EXPECT_TRUE(std::isfinite(flat.stretch));
}

TEST(Flatten, StretchIsThatOfSander) {  // a cone is isometric but for its rim; a hemisphere is not
  EXPECT_NEAR(flatten(bent_grid(8, 8, 1)).stretch, 1, 1e-3);
  double const stretch = flatten(hemisphere()).stretch;  // stereographic: between 1.0 and 1.3
  EXPECT_GT(stretch, 1.02);
  EXPECT_LT(stretch, 1.3);
}

}  // namespace
}  // namespace vitrine::test
