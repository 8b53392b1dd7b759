// SPDX-License-Identifier: Apache-2.0
// Simplification to 3000 triangles, and what comes before it, over doubling sizes: 62,500 triangles to a million.
// The rate should stay level: where it falls, the mesh has left the cache or a queue has grown too deep.
#include "stages/clean.h"
#include "stages/simplify.h"
#include "tests/support/meshes.h"

#include <benchmark/benchmark.h>

#include <cmath>

namespace vitrine {
namespace {

/// A bumpy sphere of about this many triangles.
TriMesh mesh_of(benchmark::State const& state) {
  int const stacks = int(std::sqrt(double(state.range(0)) / 4));
  return test::bumpy_sphere(2 * stacks, stacks);
}

void count_triangles(benchmark::State& state, TriMesh const& mesh) {
  state.counters["triangles per CPU second"] =
      benchmark::Counter(double(mesh.triangles.size()), benchmark::Counter::kIsIterationInvariantRate);
}

void simplify_to_3000(benchmark::State& state, Decimator decimator) {
  TriMesh const mesh = mesh_of(state);
  SimplifyOptions options;
  options.decimator = decimator;
  for (auto _ : state) benchmark::DoNotOptimize(simplify(mesh, options));
  count_triangles(state, mesh);
}

void BM_SimplifyOptimal(benchmark::State& state) { simplify_to_3000(state, Decimator::optimal); }
void BM_SimplifyOpenmesh(benchmark::State& state) { simplify_to_3000(state, Decimator::openmesh); }

void BM_Clean(benchmark::State& state) {
  SourceModel const model = test::plain_model(mesh_of(state));
  for (auto _ : state) benchmark::DoNotOptimize(clean(model));
  count_triangles(state, model.mesh);
}

void BM_Weld(benchmark::State& state) {
  SourceModel const model = test::plain_model(mesh_of(state));
  for (auto _ : state) benchmark::DoNotOptimize(weld(model));
  count_triangles(state, model.mesh);
}

void doubling(benchmark::internal::Benchmark* bench) {
  for (int triangles = 62'500; triangles <= 1'000'000; triangles *= 2) bench->Arg(triangles);
  bench->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();
}

BENCHMARK(BM_SimplifyOptimal)->Apply(doubling);
BENCHMARK(BM_SimplifyOpenmesh)->Arg(62'500)->Unit(benchmark::kMillisecond)->Iterations(1);  // 20 times as slow
BENCHMARK(BM_Clean)->Apply(doubling);
BENCHMARK(BM_Weld)->Apply(doubling);

}  // namespace
}  // namespace vitrine

BENCHMARK_MAIN();
