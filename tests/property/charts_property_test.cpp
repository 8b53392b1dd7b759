// SPDX-License-Identifier: Apache-2.0
// What segment, parameterize and pack promise, for all meshes of tests/support and for seeded ones.
#include <gmock/gmock.h>
#include <oneapi/tbb/global_control.h>

#include <cmath>
#include <functional>
#include <map>

#include "stages/pack.h"
#include "stages/parameterize.h"
#include "stages/segment.h"
#include "tests/support/meshes.h"

namespace vitrine::test {
namespace {

using testing::IsEmpty;

TriMesh sliver_strip() {  // a grid a thousand times longer than wide, with a few faces of no area
  TriMesh mesh = grid(40, 2);
  for (V3f& p : mesh.positions) p.x *= 1000;
  mesh.positions[5] = mesh.positions[4];
  return mesh;
}

std::map<std::string, std::function<TriMesh()>> const kMeshes{
    {"triangle", triangle},
    {"tetrahedron", tetrahedron},
    {"cube", [] { return cube(); }},
    {"cube far away",
     [] {
       return cube({1e5f, -2e5f, 3e5f}, 1);
     }},
    {"tiny cube",
     [] {
       return cube({0, 0, 0}, 1e-15f);
     }},
    {"cone", [] { return open_cone(); }},
    {"grid", [] { return grid(12, 7); }},
    {"sphere", [] { return sphere(16, 12); }},
    {"torus", [] { return torus(20, 10); }},
    {"genus 9", [] { return pierced_slab(3); }},
    {"Moebius strip", [] { return moebius(); }},
    {"sliver", sliver},
    {"sliver strip", sliver_strip},
    {"non-manifold edge", non_manifold_edge},
    {"two shells", two_shells},
    {"bumpy sphere 1", [] { return bumpy_sphere(20, 12, 1); }},
    {"bumpy sphere 2", [] { return bumpy_sphere(12, 24, 2); }},
    {"bumpy sphere 3", [] { return bumpy_sphere(18, 18, 3); }},
};

class Charts : public testing::TestWithParam<std::string> {
 protected:
  TriMesh const mesh = kMeshes.at(GetParam())();
};

INSTANTIATE_TEST_SUITE_P(Meshes, Charts, testing::ValuesIn([] {
                           std::vector<std::string> names;
                           for (auto const& [name, make] : kMeshes) names.push_back(name);
                           return names;
                         }()),
                         [](auto const& mesh_name) {
                           std::string name = mesh_name.param;
                           std::erase_if(name, [](char c) { return !std::isalnum(c); });
                           return name;
                         });

TEST_P(Charts, EveryFaceIsInOneDisk) { EXPECT_THAT(check(segment(mesh)), IsEmpty()); }

TEST_P(Charts, LieFlatWithoutFoldOrOverlapAndKeepTheirArea) {
  EXPECT_THAT(check(parameterize(segment(mesh))), IsEmpty());
}

TEST_P(Charts, OwnTheirTexelsAndKeepTheGutter) {
  FlatCharts const flat = parameterize(segment(mesh));
  for (Packing packing : {Packing::shapes, Packing::boxes})
    for (int gutter : {1, 4}) {
      SCOPED_TRACE("gutter " + std::to_string(gutter) + (packing == Packing::boxes ? ", boxes" : ", shapes"));
      EXPECT_THAT(check(pack(flat, {.texture = 96, .gutter = gutter, .packing = packing})), IsEmpty());
    }
}

TEST_P(Charts, ArePackedBySimilaritiesOfOneScale) {
  FlatCharts const flat = parameterize(segment(mesh));
  Atlas const atlas = pack(flat, {.texture = 128});
  double scale = 0, longest = 0;  // from the longest edge: the others are too short to tell it
  for (int pass = 0; pass < 2; ++pass)
    for (std::size_t f = 0; f < flat.corner_uvs.size(); ++f)
      for (std::size_t i = 0; i < 3; ++i) {
        double const before = (flat.corner_uvs[f][(i + 1) % 3] - flat.corner_uvs[f][i]).length();
        double const after = (atlas.corner_uvs[f][(i + 1) % 3] - atlas.corner_uvs[f][i]).length();
        if (pass == 0 && before > longest) longest = before, scale = after / before;
        if (pass == 1) {
          EXPECT_NEAR(after, scale * before, 2e-6) << "face " << f << ", edge " << i;
        }
      }
}

TEST_P(Charts, AreTheSameWithOneThreadAndTwo) {
  auto const run = [&](std::size_t threads) {
    tbb::global_control const limit(tbb::global_control::max_allowed_parallelism, threads);
    return pack(parameterize(segment(mesh)), {.texture = 64});
  };
  Atlas const one = run(1), two = run(2);
  EXPECT_EQ(one.face_charts, two.face_charts);
  EXPECT_EQ(one.corner_uvs, two.corner_uvs);
}

TEST_P(Charts, FollowARigidMotion) {
  TriMesh turned = mesh;
  for (V3f& p : turned.positions) p = V3f(p.z, p.x, p.y);  // a third of a turn about the diagonal: exact
  FlatCharts const still = parameterize(segment(mesh)), moved = parameterize(segment(turned));
  EXPECT_EQ(still.face_charts, moved.face_charts);
  ASSERT_EQ(still.charts, moved.charts);
  for (std::size_t c = 0; c < still.charts; ++c)
    EXPECT_NEAR(still.stretch[c], moved.stretch[c], 1e-3 * still.stretch[c]);
}

}  // namespace
}  // namespace vitrine::test
