// SPDX-License-Identifier: Apache-2.0
// What both decimators promise for any mesh, and where ours must be the better one.
#include "stages/clean.h"
#include "stages/progression.h"
#include "stages/simplify.h"
#include "tests/support/mesh_checks.h"
#include "tests/support/meshes.h"

#include <gmock/gmock.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>

namespace vitrine {
namespace {

using test::area_vector;
using test::mean_distance;
using test::open_edges;

std::size_t faces_without_area(TriMesh const& mesh) {
  return std::ranges::count_if(mesh.triangles, [&](Triangle const& t) { return !(area_vector(mesh, t).length() > 0); });
}

std::size_t unused_vertices(TriMesh const& mesh) {
  std::vector<bool> used(mesh.positions.size(), false);
  for (Triangle const& t : mesh.triangles)
    for (std::uint32_t v : t) used[v] = true;
  return std::ranges::count(used, false);
}

/// Faces of a mesh around the origin that look inwards.
std::size_t faces_inwards(TriMesh const& mesh) {
  return std::ranges::count_if(mesh.triangles, [&](Triangle const& t) {
    return area_vector(mesh, t).dot(V3d(mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]])) <= 0;
  });
}

SimplifyOptions to_triangles(int triangles, Decimator decimator) {
  SimplifyOptions options;
  options.triangles = triangles;
  options.decimator = decimator;
  return options;
}

/// Faces between vertices at random: hardly an edge or vertex is manifold.
TriMesh tangle(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0, 1);
  SourceModel model;
  for (int v = 0; v < 60; ++v) model.mesh.positions.push_back({unit(random), unit(random), unit(random)});
  for (int f = 0; f < 600; ++f) {
    std::array<std::uint32_t, 3> t{};
    for (std::uint32_t& v : t) v = static_cast<std::uint32_t>(random() % 60);
    model.mesh.triangles.push_back(t);
  }
  return weld(clean(model).model);
}

TriMesh shuffled(TriMesh mesh, unsigned seed) {
  std::mt19937 random(seed);
  std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), random);
  return mesh;
}

TriMesh moved(TriMesh mesh, V3f const& by) {
  for (V3f& p : mesh.positions) p += by;
  return mesh;
}

std::vector<std::pair<std::string, TriMesh>> meshes() {
  return {{"sphere", test::sphere(36, 24)},
          {"needles at the poles", test::sphere(100, 6)},
          {"torus", test::torus(48, 24)},
          {"bumpy sphere 1", test::bumpy_sphere(36, 24, 1)},
          {"bumpy sphere 2", shuffled(test::bumpy_sphere(36, 24, 2), 2)},
          {"far from the origin", moved(test::bumpy_sphere(36, 24, 3), V3f(1e4f, 0, 0))},
          {"grid", test::grid(30, 20)},
          {"cone", test::open_cone(100)},
          {"moebius", test::moebius(300)},
          {"tangle 1", tangle(1)},
          {"tangle 2", tangle(2)}};
}

class SimplifyProperty : public testing::TestWithParam<Decimator> {};
INSTANTIATE_TEST_SUITE_P(Decimators, SimplifyProperty, testing::Values(Decimator::optimal, Decimator::openmesh),
                         [](auto const& test) { return std::string(EnumNames<Decimator>::names[int(test.param)]); });

TEST_P(SimplifyProperty, ReachesTheTargetOrSaysWhyNotAndStaysAMesh) {
  for (auto const& [name, mesh] : meshes())
    for (int target : {4, 40, 250}) {
      SCOPED_TRACE(name + " to " + std::to_string(target));
      auto const [light, error, stop, uvs] = simplify(mesh, to_triangles(target, GetParam()));
      EXPECT_EQ(stop == StopReason::target_reached, light.triangles.size() <= std::size_t(target));
      EXPECT_FALSE(light.triangles.empty());
      EXPECT_THAT(check(light), testing::IsEmpty());
      EXPECT_EQ(faces_without_area(light), 0u);
      EXPECT_EQ(unused_vertices(light), 0u);
      EXPECT_TRUE(std::isfinite(error));
    }
}

TEST_P(SimplifyProperty, ClosedStaysClosed) {
  for (auto const& [name, mesh] : meshes()) {
    if (open_edges(mesh) > 0) continue;
    EXPECT_EQ(open_edges(simplify(mesh, to_triangles(100, GetParam())).mesh), 0u) << name;
  }
}

TEST_P(SimplifyProperty, FacesOfAConvexShapeStillLookOutwards) {
  for (int target : {20, 100, 500})
    EXPECT_EQ(faces_inwards(simplify(test::sphere(36, 24), to_triangles(target, GetParam())).mesh), 0u) << target;
}

TEST_P(SimplifyProperty, ReportsNoLessThanTheMeanDistance) {
  for (unsigned seed = 1; seed <= 3; ++seed)
    for (int target : {100, 400}) {
      TriMesh const mesh = test::bumpy_sphere(36, 24, seed);
      SimplifiedMesh const light = simplify(mesh, to_triangles(target, GetParam()));
      EXPECT_GE(light.error, mean_distance(mesh, light.mesh)) << "seed " << seed << ", target " << target;
    }
}

TEST(SimplifyOptimalProperty, IsTheSameForOneThreadAndTwo) {
  TriMesh const mesh = test::bumpy_sphere(300, 200);
  SourceModel soup;
  for (Triangle const& t : mesh.triangles) {
    auto const first = static_cast<std::uint32_t>(soup.mesh.positions.size());
    for (std::uint32_t v : t) soup.mesh.positions.push_back(mesh.positions[v]);
    soup.mesh.triangles.push_back({first, first + 1, first + 2});
  }
  auto run = [&](int threads) {
    return tbb::task_arena(threads).execute(
        [&] { return simplify(weld(clean(soup).model), to_triangles(2000, Decimator::optimal)); });
  };
  SimplifiedMesh const one = run(1), two = run(2);
  EXPECT_EQ(one.mesh.positions, two.mesh.positions);
  EXPECT_EQ(one.mesh.triangles, two.mesh.triangles);
  EXPECT_EQ(one.error, two.error);
}

TEST(SimplifyOptimalProperty, ReachesAnyTarget) {
  for (auto const& [name, mesh] : meshes())
    for (int target : {4, 11, 100})
      EXPECT_EQ(simplify(mesh, to_triangles(target, Decimator::optimal)).stop, StopReason::target_reached)
          << name << " to " << target;
}

TEST(SimplifyOptimalProperty, KeepsTheHoleOfATorus) {
  TriMesh const light = simplify(test::torus(48, 24), to_triangles(60, Decimator::optimal)).mesh;
  EXPECT_EQ(light.positions.size() * 2, light.triangles.size()) << "Euler's characteristic is not 0";
}

TEST(SimplifyOptimalProperty, ScalesWithTheModel) {
  TriMesh const mesh = test::bumpy_sphere(36, 24);
  TriMesh const light = simplify(mesh, to_triangles(200, Decimator::optimal)).mesh;
  for (float scale : {0x1p-40f, 0x1p30f}) {
    TriMesh scaled = mesh;
    for (V3f& p : scaled.positions) p *= scale;
    TriMesh back = simplify(scaled, to_triangles(200, Decimator::optimal)).mesh;
    for (V3f& p : back.positions) p /= scale;
    EXPECT_EQ(back.positions, light.positions) << scale;
  }
}

TEST(SimplifyOptimalProperty, IsAFifthNearerThanOpenmesh) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    TriMesh const mesh = test::bumpy_sphere(40, 40, seed);
    double const ours = mean_distance(mesh, simplify(mesh, to_triangles(300, Decimator::optimal)).mesh);
    double const theirs = mean_distance(mesh, simplify(mesh, to_triangles(300, Decimator::openmesh)).mesh);
    EXPECT_LT(ours, 0.8 * theirs) << "seed " << seed;
  }
}

/// Each level against a simplification of its own.
void expect_same_levels(TriMesh const& mesh, std::initializer_list<int> counts, double max_error = 1) {
  SimplifyOptions options;
  options.max_error = max_error;
  Progression const progression(mesh, options);
  for (int count : counts) {
    SCOPED_TRACE(count);
    options.triangles = count;
    SimplifiedMesh const direct = simplify(mesh, options), level = progression.at(std::size_t(count));
    EXPECT_EQ(level.mesh.triangles, direct.mesh.triangles);
    EXPECT_EQ(level.mesh.positions, direct.mesh.positions);
    EXPECT_EQ(level.error, direct.error);
    EXPECT_EQ(level.stop, direct.stop);
  }
}

TEST(ProgressionProperty, GivesWhatASimplificationToThatManyGives) {
  for (auto const& [name, mesh] : meshes()) {
    SCOPED_TRACE(name);
    expect_same_levels(mesh, {4, 5, 40, 99, 250, 1000, 100'000});
  }
}

TEST(ProgressionProperty, GivesTheSameFromALargeMesh) {
  TriMesh const mesh = test::bumpy_sphere(300, 200);
  ASSERT_GT(mesh.triangles.size(), Progression::kFinest);
  expect_same_levels(mesh, {4, 1000, 20'001, int(Progression::kFinest)});
  EXPECT_EQ(Progression(mesh, {}).at(1'000'000).mesh.triangles.size(), Progression::kFinest);
}

TEST(ProgressionProperty, HeedsColoursAsASimplificationDoes) {
  TriMesh const mesh = test::bumpy_sphere(60, 40);
  std::vector<V3f> colours;
  for (V3f const& p : mesh.positions) colours.push_back(V3f(p.x > 0.2f, p.y > 0, 0));
  VertexColours const heeded{colours, 0.05};
  Progression const progression(mesh, {}, heeded);
  for (int count : {50, 700}) {
    TriMesh const direct = simplify(mesh, to_triangles(count, Decimator::optimal), heeded).mesh;
    EXPECT_EQ(progression.at(std::size_t(count)).mesh.positions, direct.positions);
    EXPECT_NE(simplify(mesh, to_triangles(count, Decimator::optimal)).mesh.positions, direct.positions);
  }
}

TEST(ProgressionProperty, EndsWhereTheErrorLimitEndsIt) {
  expect_same_levels(test::bumpy_sphere(36, 24), {4, 300, 1200}, 0.002);
}

TEST(SimplifyChecks, CanFail) {
  TriMesh mesh = test::sphere();
  EXPECT_EQ(open_edges(mesh) + faces_inwards(mesh) + faces_without_area(mesh) + unused_vertices(mesh), 0u);
  std::swap(mesh.triangles[0][1], mesh.triangles[0][2]);
  EXPECT_EQ(open_edges(mesh), 3u);
  EXPECT_EQ(faces_inwards(mesh), 1u);
  mesh.triangles[1] = {1, 2, 2};
  EXPECT_EQ(faces_without_area(mesh), 1u);
  mesh.positions.push_back({0, 0, 0});
  EXPECT_EQ(unused_vertices(mesh), 1u);
  EXPECT_NEAR(mean_distance(test::grid(9, 9), moved(test::grid(9, 9), V3f(0, 1, 0))), 1 / std::sqrt(162.0), 1e-6);
}

}  // namespace
}  // namespace vitrine
