// SPDX-License-Identifier: Apache-2.0
#include "stages/cluster.h"

#include "stages/clean.h"
#include "tests/support/meshes.h"

#include <gmock/gmock.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace vitrine {
namespace {

constexpr ClusterOptions kFew{.above = 10'000, .triangles = 8'000};

SourceModel scan() { return test::painted_model(test::bumpy_sphere(400, 200)); }

/// A square of 2 n^2 faces in the plane z.
void add_sheet(TriMesh& mesh, std::uint32_t n, float z) {
  auto const first = std::uint32_t(mesh.positions.size());
  for (std::uint32_t i = 0; i <= n; ++i)
    for (std::uint32_t j = 0; j <= n; ++j) mesh.positions.emplace_back(float(i) / float(n), float(j) / float(n), z);
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < n; ++j) {
      std::uint32_t const a = first + i * (n + 1) + j, b = a + n + 1;
      mesh.triangles.push_back({a, b, a + 1});
      mesh.triangles.push_back({a + 1, b, b + 1});
    }
}

double area(TriMesh const& mesh) {
  double sum = 0;
  for (auto const& [a, b, c] : mesh.triangles)
    sum += double((mesh.positions[b] - mesh.positions[a]).cross(mesh.positions[c] - mesh.positions[a]).length()) / 2;
  return sum;
}

std::vector<float> sorted_heights(SourceModel const& model) {
  std::vector<float> heights;
  for (V3f const& p : model.mesh.positions) heights.push_back(p.y);
  std::sort(heights.begin(), heights.end());
  return heights;
}

TEST(Cluster, LeavesAboutAsManyTrianglesAsAskedForOfTheSameSurface) {
  SourceModel const whole = scan();
  SourceModel const thin = clean(cluster(whole, kFew).value()).model;
  EXPECT_GT(thin.mesh.triangles.size(), 4'000u);
  EXPECT_LT(thin.mesh.triangles.size(), 16'000u);
  EXPECT_NEAR(area(thin.mesh) / area(whole.mesh), 1, 0.02);
}

TEST(Cluster, TwoSheetsInOneCellStayTwo) {
  SourceModel model;
  add_sheet(model.mesh, 150, 0);
  add_sheet(model.mesh, 150, 1e-4f);
  SourceModel const thin = clean(cluster(model, kFew).value()).model;
  for (V3f const& p : thin.mesh.positions) EXPECT_TRUE(std::abs(p.z) < 1e-6f || std::abs(p.z - 1e-4f) < 1e-6f) << p.z;
  EXPECT_NEAR(area(thin.mesh), 2, 0.1);  // half a cell is lost at the edges
}

TEST(Cluster, TheOrderOfVerticesAndFacesDoesNotMatter) {
  SourceModel const whole = scan();
  SourceModel mixed = whole;
  std::mt19937 random(7);
  std::vector<std::uint32_t> place(whole.mesh.positions.size());
  std::iota(place.begin(), place.end(), 0u);
  std::shuffle(place.begin(), place.end(), random);
  for (std::size_t v = 0; v < place.size(); ++v)
    mixed.mesh.positions[place[v]] = whole.mesh.positions[v], mixed.colours[place[v]] = whole.colours[v];
  for (Triangle& t : mixed.mesh.triangles)
    for (std::uint32_t& v : t) v = place[v];
  std::shuffle(mixed.mesh.triangles.begin(), mixed.mesh.triangles.end(), random);
  SourceModel const a = cluster(whole, kFew).value(), b = cluster(mixed, kFew).value();
  EXPECT_EQ(a.mesh.triangles.size(), b.mesh.triangles.size());
  EXPECT_THAT(sorted_heights(a), testing::Pointwise(testing::FloatNear(1e-6f), sorted_heights(b)));
}

TEST(Cluster, SoupHangsTogetherAtEqualPlaces) {
  SourceModel const whole = test::plain_model(test::bumpy_sphere(400, 200));
  SourceModel soup;
  for (Triangle const& t : whole.mesh.triangles) {
    auto const first = std::uint32_t(soup.mesh.positions.size());
    for (std::uint32_t v : t) soup.mesh.positions.push_back(whole.mesh.positions[v]);
    soup.mesh.triangles.push_back({first, first + 1, first + 2});
  }
  EXPECT_EQ(cluster(soup, kFew)->mesh.triangles.size(), cluster(whole, kFew)->mesh.triangles.size());
}

TEST(Cluster, OneColourStaysOneColour) {
  SourceModel model = scan();
  std::fill(model.colours.begin(), model.colours.end(), Rgba16{100, 2000, 30'000, 65'535});
  SourceModel const thin = cluster(model, kFew).value();
  for (Rgba16 const& colour : thin.colours) EXPECT_EQ(colour, (Rgba16{100, 2000, 30'000, 65'535}));
}

TEST(Cluster, PlacesThatAreNoneCostTheirFacesAlone) {
  SourceModel model = scan();
  model.mesh.positions[1000].x = std::numeric_limits<float>::quiet_NaN();
  model.mesh.positions[2000].y = std::numeric_limits<float>::infinity();
  CleanModel const thin = clean(cluster(model, kFew).value());
  EXPECT_EQ(thin.repairs.nonfinite_vertices, 2u);
  EXPECT_NEAR(area(thin.model.mesh) / area(scan().mesh), 1, 0.03);
}

TEST(Cluster, ThreadsDoNotChangeABit) {
  SourceModel const model = scan();
  SourceModel const many = cluster(model, kFew).value();
  tbb::global_control const one(tbb::global_control::max_allowed_parallelism, 1);
  SourceModel const alone = cluster(model, kFew).value();
  EXPECT_EQ(many.mesh.positions, alone.mesh.positions);
  EXPECT_EQ(many.mesh.triangles, alone.mesh.triangles);
  EXPECT_EQ(many.colours, alone.colours);
}

TEST(Cluster, LeavesAloneWhatIsSmallTexturedOrDust) {
  EXPECT_FALSE(cluster(scan(), {}));
  SourceModel textured = scan();
  textured.uvs.resize(textured.mesh.positions.size());
  textured.images = {{1, 1, 3, ColourSpace::srgb, {0, 0, 0}}};
  EXPECT_FALSE(cluster(textured, kFew));
  SourceModel dust;  // parts far smaller than a cell, far apart
  for (int i = 0; i < 20'000; ++i) {
    V3f const at(float(i % 100), float(i / 100), 0);
    auto const first = std::uint32_t(dust.mesh.positions.size());
    for (V3f const& corner : {V3f(0, 0, 0), V3f(1e-3f, 0, 0), V3f(0, 1e-3f, 0)})
      dust.mesh.positions.push_back(at + corner);
    dust.mesh.triangles.push_back({first, first + 1, first + 2});
  }
  std::optional<SourceModel> const thin = cluster(dust, {.above = 10'000, .triangles = 10'000});
  EXPECT_TRUE(!thin || thin->mesh.triangles.size() > 1000);
}

}  // namespace
}  // namespace vitrine
