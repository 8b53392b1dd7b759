// SPDX-License-Identifier: Apache-2.0
#include "stages/clean.h"

#include "stages/error.h"
#include "tests/support/meshes.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <random>

namespace vitrine {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// Each face with three vertices of its own, as STL stores it.
SourceModel soup(TriMesh const& mesh) {
  SourceModel model;
  for (Triangle const& t : mesh.triangles) {
    auto const first = static_cast<std::uint32_t>(model.mesh.positions.size());
    for (std::uint32_t v : t) model.mesh.positions.push_back(mesh.positions[v]);
    model.mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return model;
}

double distance(V3f const& a, V3f const& b) { return (a - b).length(); }

TEST(Clean, LeavesASoundModelAlone) {
  CleanModel const clean_cube = clean(test::plain_model(test::cube()));
  EXPECT_EQ(clean_cube.model.mesh.triangles, test::cube().triangles);
  EXPECT_EQ(clean_cube.model.mesh.positions, test::cube().positions);
  EXPECT_EQ(clean_cube.repairs.degenerate_faces + clean_cube.repairs.duplicate_faces, 0u);
}

TEST(Clean, DropsTheFacesOfAVertexWithoutAPlace) {
  SourceModel model = test::painted_model(test::grid(2, 1));
  model.mesh.positions[0].y = kNan;
  CleanModel const result = clean(model);
  EXPECT_EQ(result.repairs.nonfinite_vertices, 1u);
  EXPECT_THAT(result.model.mesh.triangles, SizeIs(2));
  EXPECT_THAT(result.model.mesh.positions, SizeIs(4)) << "the vertex below it is used no more";
  EXPECT_THAT(result.model.colours, SizeIs(4));
}

TEST(Clean, HoldsNoPlaceBeyondTheSquareRootOfFloat) {
  SourceModel model = test::plain_model(test::two_shells());
  model.mesh.positions[0].x = -2e18f;
  EXPECT_EQ(clean(model).repairs.nonfinite_vertices, 1u);
}

TEST(Clean, DropsFacesWithoutArea) {
  SourceModel model = test::plain_model(test::triangle());
  model.mesh.positions.insert(model.mesh.positions.end(), {{1, 0, 0}, {0.1f, 0.2f, 0.7f}, {0.3f, 0.6f, 2.1f}});
  model.mesh.triangles.push_back({0, 1, 1});  // a corner twice
  model.mesh.triangles.push_back({1, 2, 3});  // a place twice
  model.mesh.triangles.push_back({0, 4, 5});  // three places on one line
  CleanModel const result = clean(model);
  EXPECT_EQ(result.repairs.degenerate_faces, 3u);
  EXPECT_THAT(result.model.mesh.triangles, ElementsAre(Triangle{0, 1, 2}));
  EXPECT_THAT(result.model.mesh.positions, SizeIs(3));
}

TEST(Clean, KeepsASliver) { EXPECT_THAT(clean(test::plain_model(test::sliver())).model.mesh.triangles, SizeIs(1)); }

TEST(Clean, KeepsTheLastFaceAtThreePlacesUnlessItIsTheOtherSideOfTheFirst) {
  SourceModel model = soup(test::grid(1, 1));
  model.mesh.triangles.push_back({5, 4, 3});
  model.mesh.triangles.push_back({1, 2, 0});
  model.face_materials = {0, 1, 1, 3};
  model.materials.resize(4);
  CleanModel const result = clean(model);
  EXPECT_EQ(result.repairs.duplicate_faces, 2u);
  EXPECT_THAT(result.model.mesh.triangles, ElementsAre(Triangle{3, 4, 5}, Triangle{1, 2, 0}));
  EXPECT_THAT(result.model.face_materials, ElementsAre(1, 3));

  model.face_materials = {0, 1, 2, 3};
  EXPECT_THAT(clean(model).model.mesh.triangles, ElementsAre(Triangle{5, 4, 3}, Triangle{1, 2, 0}));
}

TEST(Clean, RefusesAModelWithoutArea) {
  SourceModel model = test::plain_model(test::triangle());
  model.mesh.positions[2] = {2, 0, 0};
  try {
    clean(model);
    FAIL() << "no error";
  } catch (Error const& error) {
    EXPECT_EQ(error.kind(), ErrorKind::invalid_input);
    EXPECT_STREQ(error.what(), "none of 1 faces has an area");
  }
}

TEST(Clean, TurnsAModelRoundThatIsWoundAgainstItsNormals) {
  SourceModel model = test::plain_model(test::sphere());
  model.normals = model.mesh.positions;
  for (Triangle& t : model.mesh.triangles) std::swap(t[1], t[2]);
  model.normals[5] = {0, 0, 0};
  CleanModel const result = clean(model);
  EXPECT_EQ(result.repairs.flipped_faces, result.model.mesh.triangles.size());
  EXPECT_EQ(result.model.mesh.triangles, test::sphere().triangles);
  EXPECT_LT(distance(result.model.normals[5], result.model.mesh.positions[5]), 0.1) << "repaired after the turn";
}

TEST(Clean, RepairsNormalsWithoutDirectionAndMakesTheOthersUnit) {
  SourceModel model = test::plain_model(test::grid(1, 1));
  model.normals = {{0, 2, 0}, {0, 0, 0}, {kNan, 0, 0}, {0, 1, 0}};
  CleanModel const result = clean(model);
  EXPECT_EQ(result.repairs.repaired_normals, 2u);
  EXPECT_FALSE(result.computed_normals);
  EXPECT_THAT(result.model.normals, testing::Each(V3f(0, 1, 0)));
}

TEST(Clean, GivesSoupTheNormalsOfItsWeldedPlaces) {
  CleanModel const result = clean(soup(test::sphere()));
  EXPECT_TRUE(result.computed_normals);
  for (std::size_t v = 0; v < result.model.normals.size(); ++v)
    ASSERT_LT(distance(result.model.normals[v], result.model.mesh.positions[v]), 0.1) << "vertex " << v;
}

TEST(Clean, MakesAValidModelOfSeededDamage) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::mt19937 random(seed);
    SourceModel model = test::painted_model(test::bumpy_sphere(16, 8, seed));
    model.normals = smooth_normals(model.mesh);
    auto any_vertex = [&] { return random() % model.mesh.positions.size(); };
    for (int i = 0; i < 5; ++i) {
      model.mesh.positions[any_vertex()] = model.mesh.positions[any_vertex()];
      model.normals[any_vertex()] *= float(i - 2);
      std::size_t const f = random() % model.mesh.triangles.size();
      model.mesh.triangles[f][random() % 3] = static_cast<std::uint32_t>(any_vertex());
      model.mesh.triangles.push_back(model.mesh.triangles[f]);
    }
    model.mesh.positions[any_vertex()].z = kNan;
    CleanModel const result = clean(model);
    EXPECT_THAT(check(result.model), IsEmpty()) << "seed " << seed;
    EXPECT_GT(result.repairs.duplicate_faces + result.repairs.degenerate_faces, 0u) << "seed " << seed;
  }
}

TEST(SmoothNormals, AreThoseOfAnyScaleAndPlace) {
  for (float scale : {1e-30f, 1.0f, 1e30f}) {
    TriMesh mesh = test::grid(2, 2);
    for (V3f& p : mesh.positions) p *= scale;
    EXPECT_THAT(smooth_normals(mesh), testing::Each(V3f(0, 1, 0))) << scale;
  }
}

TEST(SmoothNormals, PointUpAtAVertexWithoutArea) {
  TriMesh mesh = test::triangle();
  mesh.positions.push_back({5, 5, 5});
  EXPECT_EQ(smooth_normals(mesh).back(), V3f(0, 1, 0));
}

TEST(Weld, MakesOneVertexOfEqualPlacesInTheOrderOfTheirFirstUse) {
  TriMesh const welded = weld(soup(test::grid(1, 1)));
  EXPECT_THAT(welded.positions, ElementsAre(V3f(0, 0, 0), V3f(0, 0, 1), V3f(1, 0, 1), V3f(1, 0, 0)));
  EXPECT_THAT(welded.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
}

TEST(Weld, TakesMinusZeroForZero) {
  SourceModel model = soup(test::triangle());
  for (V3f p : {V3f(-0.0f, -0.0f, 0), V3f(0, 1, -0.0f), V3f(-1, 0, 0)}) model.mesh.positions.push_back(p);
  model.mesh.triangles.push_back({3, 4, 5});
  EXPECT_THAT(weld(model).positions, SizeIs(4));
}

TEST(Weld, DropsFacesThatCollapse) {
  SourceModel model = test::plain_model(test::triangle());
  model.mesh.positions[2] = model.mesh.positions[0];
  EXPECT_THAT(weld(model).triangles, IsEmpty());
}

TEST(Weld, FindsTheSamePlacesWhereManyGroupsShareTheWork) {
  TriMesh const mesh = test::bumpy_sphere(400, 200);
  TriMesh const welded = weld(soup(mesh));
  EXPECT_EQ(welded.positions.size(), mesh.positions.size());
  EXPECT_EQ(welded.triangles.size(), mesh.triangles.size());
}

}  // namespace
}  // namespace vitrine
