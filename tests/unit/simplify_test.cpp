// SPDX-License-Identifier: Apache-2.0
#include "stages/simplify.h"

#include "stages/clean.h"
#include "stages/colour.h"
#include "stages/colour_quadric.h"
#include "stages/welded_colours.h"
#include "tests/support/meshes.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

namespace vitrine {
namespace {

using testing::SizeIs;

SimplifyOptions to_triangles(int triangles, Decimator decimator = Decimator::optimal) {
  SimplifyOptions options;
  options.triangles = triangles;
  options.decimator = decimator;
  return options;
}

void append(TriMesh& mesh, TriMesh part, V3f const& offset, float scale = 1) {
  auto const first = static_cast<std::uint32_t>(mesh.positions.size());
  for (V3f const& p : part.positions) mesh.positions.push_back(p * scale + offset);
  for (Triangle const& t : part.triangles) mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

double area(TriMesh const& mesh) {
  double sum = 0;
  for (auto const& [a, b, c] : mesh.triangles) {
    V3d const p(mesh.positions[a]);
    sum += (V3d(mesh.positions[b]) - p).cross(V3d(mesh.positions[c]) - p).length() / 2;
  }
  return sum;
}

/// Faces with a corner within `radius` of `centre`.
std::size_t faces_near(TriMesh const& mesh, V3f const& centre, float radius) {
  std::size_t count = 0;
  for (Triangle const& t : mesh.triangles) count += (mesh.positions[t[0]] - centre).length() < radius;
  return count;
}

TEST(Quadric, IsTheWeightedSquaredDistanceToItsPlanes) {
  Quadric const q = Quadric::plane({1, 0, 0}, {1, 0, 0}, 2) + Quadric::plane({0, 1, 0}, {0, 3, 0}, 1);
  EXPECT_DOUBLE_EQ(q({0, 0, 5}), 2 * 1 + 1 * 9);
  EXPECT_DOUBLE_EQ(q.weight(), 3);
}

TEST(Quadric, IsLeastWhereThreePlanesMeet) {
  Quadric const q = Quadric::plane({1, 0, 0}, {1, 0, 0}, 1) + Quadric::plane({0, 1, 0}, {0, 2, 0}, 1) +
                    Quadric::plane({0, 0, 1}, {0, 0, 3}, 1);
  EXPECT_LT((q.minimiser({0, 0, 0}, 1e-9) - V3d(1, 2, 3)).length(), 1e-6);
}

TEST(Quadric, StaysNearWhereItsPlanesLeaveADirectionOpen) {
  Quadric const q = Quadric::plane({0, 1, 0}, {0, 2, 0}, 1);
  EXPECT_LT((q.minimiser({5, 0, 7}, 1e-6) - V3d(5, 2, 7)).length(), 1e-4);
  EXPECT_EQ(Quadric().minimiser({5, 0, 7}, 1e-6), V3d(5, 0, 7));
}

TEST(ColourQuadric, IsThatOfThePlaneWhereColourIsLinear) {
  std::array<V3d, 3> const corners{V3d(0, 0, 0), V3d(2, 0, 0), V3d(0, 0, 1)};
  std::array<V3d, 3> const colours{V3d(0, 1, 0.5), V3d(1, 1, 0), V3d(0.25, 0, 0)};
  ColourQuadric q = ColourQuadric::plane({0, 1, 0}, {0, 0, 0}, 1);
  q.add_colours(corners, colours, 1);
  EXPECT_NEAR(q.of_place()({7, 3, -5}), 9, 1e-12) << "some colour fits everywhere";
  EXPECT_EQ(q.weight(), 1);
}

TEST(ColourQuadric, SumsTheSquaresOfColoursThatDoNotAgree) {
  ColourQuadric q;  // grey 0 on one face, 1 on another of three times the weight: the best is 3/4
  std::array<V3d, 3> const corners{V3d(0, 0, 0), V3d(1, 0, 0), V3d(0, 0, 1)};
  q.add_colours(corners, {V3d(0), V3d(0), V3d(0)}, 1);
  q.add_colours(corners, {V3d(1), V3d(1), V3d(1)}, 3);
  EXPECT_NEAR(q.of_place()({4, 5, 6}), 3 * (9.0 / 16 + 3.0 / 16), 1e-12);
}

class Simplify : public testing::TestWithParam<Decimator> {};
INSTANTIATE_TEST_SUITE_P(Decimators, Simplify, testing::Values(Decimator::optimal, Decimator::openmesh),
                         [](auto const& test) { return std::string(EnumNames<Decimator>::names[int(test.param)]); });

TEST_P(Simplify, ReturnsASmallMeshAsItIsWithoutUnusedVertices) {
  TriMesh mesh = test::cube();
  mesh.positions.push_back({9, 9, 9});
  SimplifiedMesh const same = simplify(mesh, to_triangles(12, GetParam()));
  EXPECT_EQ(same.mesh.triangles, test::cube().triangles);
  EXPECT_EQ(same.mesh.positions, test::cube().positions);
  EXPECT_EQ(same.error, 0);
}

TEST_P(Simplify, StopsBeforeTheErrorLimit) {
  SimplifyOptions options = to_triangles(4, GetParam());
  options.max_error = 0.002;
  SimplifiedMesh const light = simplify(test::sphere(), options);
  EXPECT_EQ(light.stop, StopReason::error_limit);
  EXPECT_LE(light.error, 0.0021f) << "OpenMesh does not look again at costs that have grown";
  EXPECT_THAT(light.mesh.triangles, SizeIs(testing::AllOf(testing::Gt(100), testing::Lt(992))));
}

TEST(SimplifyOptimal, HoldsTheOutlineOfAFlatGrid) {
  SimplifiedMesh const flat = simplify(test::grid(20, 10), to_triangles(4));
  EXPECT_THAT(flat.mesh.triangles, SizeIs(testing::Le(4)));
  EXPECT_NEAR(area(flat.mesh), 200, 0.01);
  EXPECT_NEAR(flat.error, 0, 1e-5);
}

TEST(SimplifyOptimal, KeepsAllPagesOfABook) {
  TriMesh book;  // five pages, each over the same spine: edges of five faces
  for (int page = 0; page < 5; ++page) {
    TriMesh leaf = test::grid(6, 6);
    float const angle = float(page);
    for (V3f& p : leaf.positions) p = V3f(p.x * std::cos(angle), p.x * std::sin(angle), p.z);
    append(book, leaf, V3f(0));
  }
  TriMesh const welded = weld(test::plain_model(book));
  SimplifiedMesh const light = simplify(welded, to_triangles(60));
  EXPECT_LE(light.mesh.triangles.size(), 60u);
  EXPECT_NEAR(area(light.mesh), 5 * 36, 0.5);
}

TEST(SimplifyOptimal, DustDoesNotEatTheBudget) {
  TriMesh mesh = test::bumpy_sphere(64, 32);
  double const whole = area(mesh);
  std::size_t const faces = mesh.triangles.size();
  for (int i = 0; i < 400; ++i) {
    float const angle = float(i);
    append(mesh, test::tetrahedron(), V3f(std::cos(angle), float(i % 20) / 10 - 1, std::sin(angle)) * 1.5f, 0.003f);
  }
  SimplifiedMesh const light = simplify(mesh, to_triangles(800));
  EXPECT_EQ(light.stop, StopReason::target_reached);
  EXPECT_GT(faces_near(light.mesh, {0, 0, 0}, 1.2f), 780u) << "of 800, where " << faces << " were";
  EXPECT_NEAR(area(light.mesh) / whole, 1, 0.01);
}

TEST(SimplifyOptimal, KeepsTeeth) {
  TriMesh mesh = test::bumpy_sphere(64, 32);
  std::vector<V3f> teeth;
  for (int i = 0; i < 30; ++i) teeth.push_back(V3f(std::cos(float(i) / 5), 0, std::sin(float(i) / 5)) * 1.3f);
  for (V3f const& tooth : teeth) append(mesh, test::sphere(16, 8), tooth, 0.05f);
  SimplifiedMesh const light = simplify(mesh, to_triangles(700));
  EXPECT_EQ(light.stop, StopReason::target_reached);
  for (V3f const& tooth : teeth) EXPECT_GE(faces_near(light.mesh, tooth, 0.1f), 4u);
}

TEST(SimplifyOptimal, KeepsSomethingOfEverySmallPartWhenPartsAreAllThereIs) {
  TriMesh chain;
  for (int i = 0; i < 40; ++i) append(chain, test::sphere(12, 6), V3f(float(i) * 3, 0, 0));
  SimplifiedMesh const light = simplify(chain, to_triangles(800));
  EXPECT_EQ(light.stop, StopReason::target_reached);
  for (int i = 0; i < 40; ++i) EXPECT_GE(faces_near(light.mesh, V3f(float(i) * 3, 0, 0), 1.5f), 4u) << i;
}

TEST(SimplifyOptimal,
     WhatCannotGetSimplerDoesNotOutlastTheBody) {  // holes hold ten faces each as long as topology is kept
  TriMesh guitar = test::sphere(64, 32);
  for (int i = 0; i < 40; ++i) append(guitar, test::pierced_slab(4), V3f(1.2f, 0.05f * float(i), 0), 0.004f);
  TriMesh const light = simplify(guitar, to_triangles(400)).mesh;
  EXPECT_LE(light.triangles.size(), 400u);
  EXPECT_GT(area(light), 0.85 * area(test::sphere(64, 32)));
}

TEST(SimplifyOptimal, NeverReturnsNothing) {
  TriMesh flakes;
  for (int i = 0; i < 100; ++i) append(flakes, test::triangle(), V3f(float(i) * 2, 0, 0));
  TriMesh const light = simplify(flakes, to_triangles(4)).mesh;
  EXPECT_THAT(light.triangles, SizeIs(4));
  EXPECT_THAT(light.positions, SizeIs(12));
}

/// A flat sheet, black where x + z < 30 and white elsewhere.
SourceModel two_coloured_sheet() {
  SourceModel sheet = test::plain_model(test::grid(40, 40));
  for (V3f const& p : sheet.mesh.positions) {
    std::uint16_t const c = p.x + p.z < 30 ? 0 : 65535;
    sheet.colours.push_back({c, c, c, 65535});
  }
  return sheet;
}

TEST(SimplifyOptimal, KeepsColoursApart) {
  auto const model = std::make_shared<SourceModel const>(clean(two_coloured_sheet()).model);
  TriMesh const welded = weld(*model);
  std::vector<V3f> const colours = welded_colours(survey(model), welded);
  // Of the faces' vertices, those close to the line between the colours.
  auto const on_line = [](TriMesh const& mesh) {
    return std::ranges::count_if(mesh.positions, [](V3f const& p) { return std::abs(p.x + p.z - 29.5f) < 1.5f; });
  };
  TriMesh const plain = simplify(welded, to_triangles(40)).mesh;
  TriMesh const heeding = simplify(welded, to_triangles(40), {colours, 0.02}).mesh;
  EXPECT_GT(on_line(heeding), 10);
  EXPECT_LT(on_line(plain), 5);
  EXPECT_NEAR(area(heeding), 1600, 8);
}

TEST(WeldedColours, AreThoseOfTheSurfaceInSrgb) {
  auto const model = std::make_shared<SourceModel const>(clean(test::painted_model(test::bumpy_sphere(64, 32))).model);
  TriMesh const welded = weld(*model);
  std::vector<V3f> const colours = welded_colours(survey(model), welded);
  ASSERT_EQ(colours.size(), model->colours.size()) << "no two vertices meet";
  for (std::size_t v = 0; v < colours.size(); ++v)
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(colours[v][k], linear_to_srgb(float(model->colours[v][k]) / 65535), 0.1f) << v;
}

TEST(SimplifyOptimal, ClosesAHoleOfOneFace) {
  TriMesh mesh = test::sphere(64, 32);
  mesh.triangles.erase(mesh.triangles.begin() + 2000);
  TriMesh const light = simplify(mesh, to_triangles(101)).mesh;
  EXPECT_EQ(light.triangles.size() % 2, 0u) << "a closed surface has an even number of faces";
}

TEST(SimplifyOpenmesh, CutsAndWeldsWhatIsNotManifold) {
  TriMesh mesh = test::bumpy_sphere(32, 16);
  append(mesh, test::grid(4, 4), V3f(2, 0, 0));
  mesh.triangles.push_back({0, 100, 200});  // three faces on none of its edges, three fans at its corners
  std::size_t const faces = mesh.triangles.size();
  SimplifiedMesh const light = simplify(mesh, to_triangles(int(faces) - 1, Decimator::openmesh));
  EXPECT_EQ(light.stop, StopReason::target_reached);
  EXPECT_GE(light.mesh.triangles.size(), faces - 2) << "no face is lost on the way";
  EXPECT_GE(light.mesh.positions.size(), mesh.positions.size() - 2) << "fans of one vertex share it again";
  EXPECT_LE(light.mesh.positions.size(), mesh.positions.size());
}

TEST(SimplifyOpenmesh, TakesAMoebiusStrip) {
  SimplifiedMesh const light = simplify(test::moebius(64), to_triangles(40, Decimator::openmesh));
  EXPECT_EQ(light.mesh.triangles.size(), 40u);
}

}  // namespace
}  // namespace vitrine
