// SPDX-License-Identifier: Apache-2.0
#include "stages/vertex_fit.h"

#include "stages/clean.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace vitrine {
namespace {

SurfaceSamples samples_of(TriMesh const& mesh, std::size_t count = 20'000) {
  return sample_surface(survey(std::make_shared<SourceModel const>(clean(test::plain_model(mesh)).model)), count);
}

template <class Value>
std::vector<V3f> at_samples(SurfaceSamples const& samples, Value const& value) {
  std::vector<V3f> values;
  for (V3f const& p : samples.points) values.push_back(value(p));
  return values;
}

TEST(VertexFit, GivesConstantsBackExactly) {
  TriMesh const mesh = test::bumpy_sphere(24, 12);
  SurfaceSamples const samples = samples_of(mesh);
  V3f const value(0.25f, 0.5f, 0.75f);
  std::vector<V3f> const none(mesh.positions.size(), V3f(0));
  for (double smoothing : {0.0, 0.3, 1.0, 5.0})
    for (V3f const& v :
         VertexFit(mesh, samples)(at_samples(samples, [&](V3f const&) { return value; }), none, smoothing))
      EXPECT_EQ(v, value);
}

TEST(VertexFit, ReproducesALinearRamp) {
  TriMesh const mesh = test::grid(6, 5);
  SurfaceSamples const samples = samples_of(mesh);
  auto const ramp = [](V3f const& p) { return V3f(p.x, p.z, p.x - 2 * p.z) / 6; };
  std::vector<V3f> const none(mesh.positions.size(), V3f(0));
  std::vector<V3f> const fitted = VertexFit(mesh, samples)(at_samples(samples, ramp), none, 0);
  for (std::size_t v = 0; v < fitted.size(); ++v) EXPECT_LT((fitted[v] - ramp(mesh.positions[v])).length(), 0.01f);
}

TEST(VertexFit, SmoothingOfOneIsTheMeanAround) {
  TriMesh const mesh = test::grid(1, 1);  // each of two corners has a face of its own
  SurfaceSamples const samples = samples_of(mesh);
  std::vector<V3f> const none(mesh.positions.size(), V3f(0));
  auto const height = [](V3f const& p) { return V3f(p.x, 0, 0); };
  std::vector<V3f> const fitted = VertexFit(mesh, samples)(at_samples(samples, height), none, 1);
  for (std::size_t v = 0; v < fitted.size(); ++v) {
    // The mean of x weighted by one corner's share: a quarter of that corner's x for each of the others, half for it.
    V3d sum(0);
    double faces = 0;
    for (Triangle const& t : mesh.triangles)
      for (int k = 0; k < 3; ++k)
        if (t[k] == v)
          for (int j = 0; j < 3; ++j, faces += 1. / 3) sum += V3d(mesh.positions[t[j]]) * (j == k ? 0.5 : 0.25);
    EXPECT_NEAR(fitted[v].x, sum.x / faces, 0.01);
  }
}

TEST(VertexFit, SmoothsFurtherWithMore) {
  TriMesh const mesh = test::grid(16, 16);
  SurfaceSamples const samples = samples_of(mesh);
  auto const checks = [](V3f const& p) { return V3f(float((int(p.x / 1.5f) + int(p.z / 1.5f)) % 2)); };
  std::vector<V3f> const values = at_samples(samples, checks), none(mesh.positions.size(), V3f(0));
  VertexFit const fit(mesh, samples);
  double before = INFINITY;
  for (double smoothing : {0.0, 0.1, 1.0, 4.0}) {
    std::vector<V3f> const fitted = fit(values, none, smoothing);
    double variation = 0;
    for (Triangle const& t : mesh.triangles)
      for (int k = 0; k < 3; ++k) variation += std::abs(fitted[t[k]].x - fitted[t[(k + 1) % 3]].x);
    EXPECT_LT(variation, 0.95 * before);
    before = variation;
  }
}

TEST(VertexFit, LeavesWhatShowsNoSampleToTheCaller) {
  TriMesh mesh = test::two_shells();
  SurfaceSamples const samples = samples_of(test::cube(mesh.positions[0] + V3f(0.5f)), 2000);
  std::vector<V3f> const otherwise(mesh.positions.size(), V3f(7));
  VertexFit const fit(mesh, samples);
  std::vector<V3f> const fitted = fit(at_samples(samples, [](V3f const&) { return V3f(1); }), otherwise, 0.1);
  for (std::size_t v = 0; v < fitted.size(); ++v) {
    EXPECT_EQ(fit.seen()[v], v < 8);
    EXPECT_EQ(fitted[v], V3f(v < 8 ? 1 : 7));
  }
}

TEST(VertexFit, ASampleWithoutWeightDoesNotCount) {
  TriMesh const mesh = test::grid(4, 4);
  SurfaceSamples const samples = samples_of(mesh);
  std::vector<V3f> values(samples.points.size(), V3f(1));
  std::vector<float> weights(samples.points.size(), 1);
  for (std::size_t s = 0; s < values.size(); s += 3) values[s] = V3f(100), weights[s] = 0;
  std::vector<V3f> const none(mesh.positions.size(), V3f(0));
  for (V3f const& v : VertexFit(mesh, samples, weights)(values, none, 0.1)) EXPECT_EQ(v, V3f(1));
}

}  // namespace
}  // namespace vitrine
