// SPDX-License-Identifier: Apache-2.0
// What a thumbnail takes from its original: maps over sizes of atlas and of original, colours per vertex over sizes of
// mesh. A bake is to cost the same whatever the original's size, but for rays through a deeper tree.
#include "perf/sizes.h"
#include "stages/bake.h"
#include "stages/pack.h"
#include "stages/paint.h"
#include "stages/parameterize.h"
#include "stages/quantize.h"
#include "stages/segment.h"

namespace vitrine::perf {
namespace {

QuantizedAtlas atlas_of(int texels) {
  PackOptions options;
  options.texture = texels;
  return quantize(pack(parameterize(segment(light_mesh(3000))), options));
}

SurveyedModel original(std::int64_t triangles) { return surveyed(clean(scan_of(triangles)).model); }

/// Arguments: side of the maps in texels, triangles of the original.
void BM_Bake(benchmark::State& state) {
  QuantizedAtlas const target = atlas_of(int(state.range(0)));
  SurveyedModel const scan = original(state.range(1));
  std::uint64_t samples = 0;
  for (auto _ : state) samples = bake(target, scan).statistics.samples;
  state.counters["samples per CPU second"] =
      benchmark::Counter(double(samples), benchmark::Counter::kIsIterationInvariantRate);
}

void BM_Paint(benchmark::State& state) {
  TriMesh const& light = light_mesh(state.range(0));
  QuantizedMesh const target = quantize(light, cube_about(light, 11));
  SurveyedModel const scan = original(250'000);
  SurfaceSamples const samples = sample_surface(scan, 120'000);
  for (auto _ : state) benchmark::DoNotOptimize(paint(target, scan, samples));
  count_triangles(state, target.mesh.triangles.size());
}

void BM_SampleSurface(benchmark::State& state) {
  SurveyedModel const scan = original(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(sample_surface(scan, 120'000));
  count_triangles(state, scan.model->mesh.triangles.size());
}

void bakes(benchmark::internal::Benchmark* bench) {
  for (int texels : {128, 256, 512, 1024}) bench->Args({texels, 250'000});
  for (int triangles : {62'500, 125'000, 500'000, 1'000'000}) bench->Args({256, triangles});
  in_milliseconds(bench);
}

BENCHMARK(BM_Bake)->Apply(bakes);
BENCHMARK(BM_Paint)->Apply(light_meshes);
BENCHMARK(BM_SampleSurface)->Apply(scans);

}  // namespace
}  // namespace vitrine::perf

BENCHMARK_MAIN();
