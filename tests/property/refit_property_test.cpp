// SPDX-License-Identifier: Apache-2.0
// Refitting and rounding bring a light mesh closer to its original and break nothing.
#include "stages/refit.h"

#include "stages/clean.h"
#include "stages/fit_energy.h"
#include "stages/simplify.h"
#include "tests/support/mesh_checks.h"
#include "tests/support/meshes.h"

#include <gmock/gmock.h>
#include <oneapi/tbb/task_arena.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>

namespace vitrine {
namespace {

using test::area_vector;
using test::mean_angle;
using test::mean_distance;
using test::open_edges;

SurveyedModel surveyed(TriMesh mesh) {
  return survey(std::make_shared<SourceModel const>(clean(test::plain_model(std::move(mesh))).model));
}

TriMesh simplified(TriMesh const& mesh, int triangles) {
  SimplifyOptions options;
  options.triangles = triangles;
  return simplify(mesh, options).mesh;
}

/// An open sheet with waves and a ragged outline.
TriMesh ragged_sheet() {
  TriMesh mesh = test::grid(60, 40);
  for (V3f& p : mesh.positions) p.y = 2 * std::sin(p.x / 6) * std::cos(p.z / 5);
  std::erase_if(mesh.triangles, [&](Triangle const& t) {
    V3f const& p = mesh.positions[t[0]];
    return p.x < 3 + 2 * std::sin(p.z) || p.z > 36 + 3 * std::cos(p.x);
  });
  return weld(test::plain_model(mesh));
}

/// A closed blade with a wavy surface and two sharp edges, whose smooth normals look across its sides.
TriMesh blade() {
  TriMesh mesh = test::sphere(80, 60);
  for (V3f& p : mesh.positions) {
    float const side = p.z > 0 ? 1.f : p.z < 0 ? -1.f : 0.f;
    p = V3f(p.x, 4 * p.y, 0.3f * side * std::max(0.f, 1 - std::abs(p.x) - p.y * p.y) * (1 + 0.1f * std::sin(9 * p.y)));
  }
  return weld(clean(test::plain_model(mesh)).model);
}

struct Case {
  std::string name;
  TriMesh original;
  int triangles;
};

std::vector<Case> cases() {
  return {{"bumpy sphere 1", test::bumpy_sphere(120, 80, 1), 500},
          {"bumpy sphere 2", test::bumpy_sphere(120, 80, 2), 1500},
          {"torus", test::torus(120, 60), 300},
          {"ragged sheet", ragged_sheet(), 400}};
}

std::size_t turned_faces(TriMesh const& before, TriMesh const& after) {
  std::size_t turned = 0;
  for (std::size_t f = 0; f < before.triangles.size(); ++f)
    turned += !(area_vector(before, before.triangles[f]).dot(area_vector(after, after.triangles[f])) > 0);
  return turned;
}

TEST(RefitProperty, BringsPlacesAndNormalsCloserAndTurnsNoFace) {
  for (auto const& [name, original, triangles] : cases()) {
    SCOPED_TRACE(name);
    TriMesh const light = simplified(original, triangles);
    TriMesh const fitted = refit(light, sample_surface(surveyed(original), 100'000));
    EXPECT_EQ(fitted.triangles, light.triangles);
    EXPECT_EQ(turned_faces(light, fitted), 0u);
    EXPECT_LT(mean_distance(original, fitted), 0.9 * mean_distance(original, light));
    EXPECT_LT(mean_angle(original, fitted), mean_angle(original, light));
  }
}

/// Area of what a mesh covers, seen from above.
double shadow(TriMesh const& mesh) {
  double sum = 0;
  for (Triangle const& t : mesh.triangles) sum += std::abs(area_vector(mesh, t).y);
  return sum;
}

TEST(RefitProperty, KeepsTheOutlineOfARaggedSheet) {
  TriMesh const original = ragged_sheet(), light = simplified(original, 400);
  TriMesh const fitted = refit(light, sample_surface(surveyed(original), 100'000));
  EXPECT_NEAR(shadow(fitted) / shadow(original), 1, std::abs(shadow(light) / shadow(original) - 1) + 0.001);
}

TEST(RefitProperty, KeepsABladeSharp) {  // fewer triangles have chords that stand out further, as fits best
  TriMesh const original = blade();
  SurfaceSamples const samples = sample_surface(surveyed(original), 100'000);
  for (int triangles : {500, 800, 1200}) {
    TriMesh const fitted = refit(simplified(original, triangles), samples);
    EXPECT_NEAR(bounds(fitted).size().x, bounds(original).size().x, 0.01) << triangles;
    EXPECT_NEAR(bounds(fitted).size().y, bounds(original).size().y, 0.01) << triangles;
  }
}

TEST(RefitProperty, LeavesAMeshAloneThatHasNoSamplesNearby) {
  TriMesh const light = simplified(test::sphere(), 100);
  TriMesh elsewhere = test::sphere();
  for (V3f& p : elsewhere.positions) p += V3f(100, 0, 0);
  EXPECT_EQ(refit(light, sample_surface(surveyed(elsewhere), 1000)).positions, light.positions);
}

TEST(RefitProperty, IsTheSameForOneThreadAndTwo) {
  TriMesh const original = test::bumpy_sphere(120, 80), light = simplified(original, 3000);
  auto const run = [&](int threads) {
    return tbb::task_arena(threads).execute([&] {
      SurfaceSamples const samples = sample_surface(surveyed(original), 100'000);
      TriMesh const fitted = refit(light, samples);
      return round_to_grid(fitted, cube_about(fitted, 9), samples).mesh;
    });
  };
  TriMesh const one = run(1), two = run(2);
  EXPECT_EQ(one.positions, two.positions);
  EXPECT_EQ(one.triangles, two.triangles);
}

/// Where a mesh with the same faces has its vertices, as moves from `from`.
std::vector<V3d> moves(FitEnergy const& energy, TriMesh const& from, TriMesh const& to) {
  std::vector<V3d> moves(from.positions.size(), V3d(0));
  for (std::size_t f = 0; f < from.triangles.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      std::uint32_t const v = from.triangles[f][k];
      moves[v] = (V3d(to.positions[to.triangles[f][k]]) - V3d(from.positions[v])) / energy.scale();
    }
  return moves;
}

TEST(RoundToGridProperty, StaysOnTheGridAndIsNoWorseThanTheNearestPlaces) {
  for (auto const& [name, original, triangles] : cases())
    for (int bits : {8, 11}) {
      SCOPED_TRACE(name + " at " + std::to_string(bits) + " bits");
      TriMesh const light = simplified(original, triangles);
      SurfaceSamples const samples = sample_surface(surveyed(original), 50'000);
      Grid const grid = cube_about(light, bits);
      TriMesh const nearest = quantize(light, grid).mesh, rounded = round_to_grid(light, grid, samples).mesh;
      GridCodes const codes(grid);
      for (V3f const& p : rounded.positions) EXPECT_EQ(codes.value(codes.code(p)), p);
      ASSERT_EQ(rounded.triangles.size(), light.triangles.size()) << "no face should vanish on grids as fine";
      EXPECT_EQ(turned_faces(light, rounded), turned_faces(light, nearest));
      EXPECT_EQ(open_edges(rounded), open_edges(light));
      FitEnergy const energy(light, samples, RefitOptions{}.facet_weight);
      EXPECT_LE(energy(moves(energy, light, rounded)), energy(moves(energy, light, nearest)));
      if (name.starts_with("bumpy")) {
        EXPECT_LT(mean_angle(original, rounded), mean_angle(original, nearest));
      }
    }
}

TEST(FitEnergyProperty, IsLeastWhereItSays) {
  TriMesh const original = test::bumpy_sphere(60, 40), light = simplified(original, 300);
  FitEnergy const energy(light, sample_surface(surveyed(original), 20'000), 1);
  std::vector<V3d> least = energy.least();
  double const at_least = energy(least);
  EXPECT_LT(at_least, 0);
  for (std::uint32_t v = 0; v < least.size(); v += 17)
    for (V3d const& by : {V3d(1e-3, 0, 0), V3d(0, -1e-3, 0), V3d(0, 0, 1e-3)}) {
      double const expected = energy.around(v, least)(by);
      least[v] += by;
      EXPECT_GT(energy(least), at_least);
      EXPECT_NEAR(energy(least) - at_least, expected, 1e-9);
      least[v] -= by;
    }
}

}  // namespace
}  // namespace vitrine
