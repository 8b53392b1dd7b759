// SPDX-License-Identifier: Apache-2.0
// Simplification to 3000 triangles over doubling sizes, up to 28 million triangles with VITRINE_PERF=full. The rate
// should stay level: where it falls, the mesh has left the cache or a queue has grown too deep.
#include "perf/sizes.h"

namespace vitrine::perf {
namespace {

void simplify_to_3000(benchmark::State& state, Decimator decimator) {
  TriMesh const mesh = mesh_of(state.range(0));
  SimplifyOptions options;
  options.decimator = decimator;
  for (auto _ : state) benchmark::DoNotOptimize(simplify(mesh, options));
  count_triangles(state, mesh.triangles.size());
}

void BM_SimplifyOptimal(benchmark::State& state) { simplify_to_3000(state, Decimator::optimal); }
void BM_SimplifyOpenmesh(benchmark::State& state) { simplify_to_3000(state, Decimator::openmesh); }

BENCHMARK(BM_SimplifyOptimal)->Apply(scans);
BENCHMARK(BM_SimplifyOpenmesh)->Arg(62'500)->Unit(benchmark::kMillisecond)->Iterations(1);  // 20 times as slow

}  // namespace
}  // namespace vitrine::perf

BENCHMARK_MAIN();
