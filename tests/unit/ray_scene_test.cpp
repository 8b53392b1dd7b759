// SPDX-License-Identifier: Apache-2.0
#include "stages/ray_scene.h"

#include "tests/support/meshes.h"

#include <gmock/gmock.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cstring>
#include <random>

namespace vitrine {
namespace {

using testing::FloatNear;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Two unit triangles facing +Z: face 0 at z = 0, face 1 at z = 1.
TriMesh two_layers() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, {{0, 1, 2}, {3, 4, 5}}};
}

TEST(RayScene, FindsTheNearerFaceWithItsBarycentricWeights) {
  TriMesh const mesh = two_layers();
  RayScene const scene(mesh);
  auto const hit = scene.first_hit({{0.25f, 0.5f, 3}, {0, 0, -1}});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->face, 1u);
  EXPECT_FLOAT_EQ(hit->u, 0.25f);
  EXPECT_FLOAT_EQ(hit->v, 0.5f);
  EXPECT_FLOAT_EQ(hit->distance, 2);
}

TEST(RayScene, HitsLieBetweenNearAndFar) {
  TriMesh const mesh = two_layers();
  RayScene const scene(mesh);
  EXPECT_EQ(scene.first_hit({{0.2f, 0.2f, 3}, {0, 0, -1}, 2.5f})->face, 0u);
  EXPECT_FALSE(scene.first_hit({{0.2f, 0.2f, 3}, {0, 0, -1}, 0, 1.5f}));
}

TEST(RayScene, FacesTurnedAwayFromTheSideLetTheRayPass) {
  TriMesh mesh = two_layers();
  std::swap(mesh.triangles[1][1], mesh.triangles[1][2]);
  RayScene const scene(mesh);
  Ray ray{{0.2f, 0.2f, 3}, {0, 0, -1}};
  ray.side = {0, 0, 1};
  EXPECT_EQ(scene.first_hit(ray)->face, 0u);
  ray.side = {0, 0, -1};
  EXPECT_EQ(scene.first_hit(ray)->face, 1u);
}

TEST(RayScene, OccludedSeesEverySide) {
  TriMesh const mesh = two_layers();
  RayScene const scene(mesh);
  EXPECT_TRUE(scene.occluded({{0.2f, 0.2f, -1}, {0, 0, 1}}));
  EXPECT_FALSE(scene.occluded({{0.2f, 0.2f, -1}, {0, 0, 1}, 0, 0.5f}));
  EXPECT_FALSE(scene.occluded({{2, 2, -1}, {0, 0, 1}}));
}

TEST(RayScene, ClosestPointIsOnTheFaceEdgeOrCorner) {
  TriMesh const mesh = test::triangle();
  RayScene const scene(mesh);
  EXPECT_FLOAT_EQ(scene.closest_point({0.2f, 0.2f, 2}, kInfinity, {0, 0, 0})->distance, 2);
  EXPECT_FLOAT_EQ(scene.closest_point({0.5f, -3, 4}, kInfinity, {0, 0, 0})->distance, 5);
  auto const corner = scene.closest_point({5, 0, 0}, kInfinity, {0, 0, 0});
  EXPECT_FLOAT_EQ(corner->u, 1);
  EXPECT_FLOAT_EQ(corner->v, 0);
}

TEST(RayScene, ClosestPointKeepsToItsRadiusAndSide) {
  TriMesh mesh = two_layers();
  std::swap(mesh.triangles[1][1], mesh.triangles[1][2]);
  RayScene const scene(mesh);
  V3f const point(0.2f, 0.2f, 0.9f);
  EXPECT_EQ(scene.closest_point(point, kInfinity, {0, 0, 0})->face, 1u);
  EXPECT_EQ(scene.closest_point(point, kInfinity, {0, 0, 1})->face, 0u);
  EXPECT_FALSE(scene.closest_point(point, 0.5f, {0, 0, 1}));
}

TEST(RayScene, ClosestPointAgreesWithBruteForce) {
  TriMesh const mesh = test::bumpy_sphere(16, 8);
  RayScene const scene(mesh);
  std::mt19937 random(7);
  std::uniform_real_distribution<float> coordinate(-1.5f, 1.5f);
  for (int i = 0; i < 200; ++i) {
    V3f const point(coordinate(random), coordinate(random), coordinate(random));
    float least = kInfinity;
    for (Triangle const& face : mesh.triangles) {
      TriMesh const single{{mesh.positions[face[0]], mesh.positions[face[1]], mesh.positions[face[2]]}, {{0, 1, 2}}};
      least = std::min(least, RayScene(single).closest_point(point, kInfinity, {0, 0, 0})->distance);
    }
    EXPECT_THAT(scene.closest_point(point, kInfinity, {0, 0, 0})->distance, FloatNear(least, 1e-5f));
  }
}

TEST(RayScene, APacketFindsWhatSingleRaysFind) {
  TriMesh const mesh = test::bumpy_sphere(64, 32);
  RayScene const scene(mesh);
  std::array<Ray, RayScene::kPacket> rays;
  for (std::size_t i = 0; i < rays.size(); ++i) rays[i] = {{0.038f * float(i) - 1.2f, 0.11f, 3}, {0, 0, -1}};
  rays[2].side = {0, 0, -1};
  rays[3].far = -1;
  auto const hits = scene.first_hits(rays);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    auto const single = scene.first_hit(rays[i]);
    ASSERT_EQ(hits[i].has_value(), single.has_value()) << i;
    if (single) {
      EXPECT_EQ(hits[i]->face, single->face) << i;
    }
  }
  EXPECT_FALSE(hits[3]);
}

/// Bits of what rays meet that go through vertices and the middles of edges.
std::vector<std::uint32_t> all_answers(TriMesh const& mesh) {
  RayScene const scene(mesh);
  std::vector<std::uint32_t> bits;
  auto const record = [&](std::optional<Hit> const& hit) {
    std::array<std::uint32_t, 4> words{};
    if (hit) std::memcpy(words.data(), &*hit, sizeof(Hit));
    bits.insert(bits.end(), words.begin(), words.end());
  };
  for (std::size_t f = 0; f < mesh.triangles.size(); f += 13)
    for (int k = 0; k < 3; ++k) {
      V3f const corner = mesh.positions[mesh.triangles[f][k]];
      V3f const middle = (corner + mesh.positions[mesh.triangles[f][(k + 1) % 3]]) * 0.5f;
      for (V3f const& target : {corner, middle}) {
        record(scene.first_hit({target * 3.0f, -target}));
        record(scene.first_hit({target, {0, 1, 0}, 0, 1, target}));
        record(scene.closest_point(target * 1.001f, 1, target));
      }
    }
  return bits;
}

TEST(RayScene, AnswersDoNotDependOnTheNumberOfThreads) {
  TriMesh mesh = test::bumpy_sphere(256, 128);
  std::vector<Triangle> const twice = mesh.triangles;
  mesh.triangles.insert(mesh.triangles.end(), twice.begin(), twice.end());
  std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), std::mt19937(1));
  tbb::global_control const allow(tbb::global_control::max_allowed_parallelism, 4);
  std::vector<std::uint32_t> one, four;
  tbb::task_arena(1).execute([&] { one = all_answers(mesh); });
  tbb::task_arena(4).execute([&] { four = all_answers(mesh); });
  EXPECT_TRUE(one == four);
}

}  // namespace
}  // namespace vitrine
