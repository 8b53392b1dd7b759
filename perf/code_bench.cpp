// SPDX-License-Identifier: Apache-2.0
// A thumbnail's file, over its triangles and the side of its maps: written, then read again and compared, as each trial
// of a search does.
#include "io/read_model.h"
#include "io/write_glb.h"
#include "perf/sizes.h"
#include "stages/bake.h"
#include "stages/measure.h"
#include "stages/pack.h"
#include "stages/parameterize.h"
#include "stages/quantize.h"
#include "stages/segment.h"

namespace vitrine::perf {
namespace {

SurveyedModel const& scan() {
  static SurveyedModel const made = surveyed(clean(scan_of(250'000)).model);
  return made;
}

BakedModel baked(benchmark::State const& state) {
  PackOptions options;
  options.texture = int(state.range(1));
  return bake(quantize(pack(parameterize(segment(light_mesh(state.range(0)))), options)), scan());
}

void BM_Encode(benchmark::State& state) {
  BakedModel const model = baked(state);
  std::size_t bytes = 0;
  for (auto _ : state) bytes = io::encode(model, "scan").glb.size();
  state.counters["bytes"] = double(bytes);
}

/// Three pictures, as the search takes from either side.
void BM_DecodeAndCompare(benchmark::State& state) {
  io::Blob const file = io::own(io::encode(baked(state), "scan").glb);
  Reference const judge = reference(scan(), {.count = 3, .supersample = 2});
  io::Resolve const nothing = [](std::string_view) { return std::nullopt; };
  for (auto _ : state)
    benchmark::DoNotOptimize(compare(
        judge.pictures, pictures(survey(std::make_shared<SourceModel const>(io::read_gltf(file, nothing))), judge)));
}

void files(benchmark::internal::Benchmark* bench) {
  for (int triangles : {500, 1000, 2000, 4000}) bench->Args({triangles, 256});
  for (int texels : {128, 512, 1024}) bench->Args({2000, texels});
  in_milliseconds(bench);
}

BENCHMARK(BM_Encode)->Apply(files);
BENCHMARK(BM_DecodeAndCompare)->Apply(files);

}  // namespace
}  // namespace vitrine::perf

BENCHMARK_MAIN();
