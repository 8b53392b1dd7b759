// SPDX-License-Identifier: Apache-2.0
// The way to an atlas, over thumbnails of doubling sizes: charts, laid flat, packed.
#include "perf/sizes.h"
#include "stages/pack.h"
#include "stages/parameterize.h"
#include "stages/segment.h"

namespace vitrine::perf {
namespace {

void BM_Segment(benchmark::State& state) {
  TriMesh const& mesh = light_mesh(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(segment(mesh));
  count_triangles(state, mesh.triangles.size());
}

/// Arguments: triangles, and 1 where charts are relaxed until faces keep their size.
void BM_Flatten(benchmark::State& state) {
  ChartedMesh const charts = segment(light_mesh(state.range(0)));
  std::vector<float> const lengths(state.range(1) ? charts.mesh.triangles.size() : 0, 1);
  for (auto _ : state) benchmark::DoNotOptimize(parameterize(charts, lengths));
  count_triangles(state, charts.mesh.triangles.size());
}

void pack_into(benchmark::State& state, Packing packing) {
  FlatCharts const flat = parameterize(segment(light_mesh(state.range(0))));
  PackOptions options;
  options.packing = packing;
  for (auto _ : state) benchmark::DoNotOptimize(pack(flat, options));
  count_triangles(state, flat.mesh.triangles.size());
}

void BM_PackShapes(benchmark::State& state) { pack_into(state, Packing::shapes); }
void BM_PackBoxes(benchmark::State& state) { pack_into(state, Packing::boxes); }

void flattenings(benchmark::internal::Benchmark* bench) {
  for (int relaxed : {0, 1})
    for (std::int64_t triangles = 500; triangles <= 8'000; triangles *= 2) bench->Args({triangles, relaxed});
  in_milliseconds(bench);
}

BENCHMARK(BM_Segment)->Apply(light_meshes);
BENCHMARK(BM_Flatten)->Apply(flattenings);
BENCHMARK(BM_PackShapes)->Apply(light_meshes);
BENCHMARK(BM_PackBoxes)->Apply(light_meshes);

}  // namespace
}  // namespace vitrine::perf

BENCHMARK_MAIN();
