// SPDX-License-Identifier: Apache-2.0
// The measure: the original's 32 views, those of a thumbnail, and their comparison. A search does the last two for
// every trial, so "s per view" is what to look at. A ball fills most of its picture: real objects cost about half of
// this.
#include "perf/sizes.h"
#include "stages/measure.h"

#include <numbers>

namespace vitrine::perf {
namespace {

SurveyedModel original(int triangles) { return surveyed(clean(scan_of(triangles)).model); }

/// Smooth, with a colour map and a normal map wound round it.
SourceModel textured_model(TriMesh mesh) {
  SourceModel model = clean(test::plain_model(std::move(mesh))).model;
  for (V3f const& p : model.mesh.positions)
    model.uvs.push_back({std::atan2(p.x, p.z) / (2 * std::numbers::pi_v<float>)+0.5f, (1 - p.y) / 2});
  Image image{256, 256, 3, ColourSpace::srgb, {}};
  for (int i = 0; i < 256 * 256 * 3; ++i) image.texels.push_back(static_cast<std::uint8_t>(i * 7));
  model.images = {image, image};
  model.materials[0].coloured = true;
  model.materials[0].colour_map.image = 0;
  model.materials[0].normal_map.image = 1;
  model.tangents.assign(model.uvs.size(), {1, 0, 0, 1});
  return model;
}

enum class Kind { flat, textured };  ///< colours per vertex without normals, or smooth with both maps

SurveyedModel thumbnail(Kind kind, int triangles) {
  TriMesh mesh = mesh_of(triangles);
  return surveyed(kind == Kind::flat ? test::painted_model(std::move(mesh)) : textured_model(std::move(mesh)));
}

void count_views(benchmark::State& state, int views) {
  state.counters["s per view"] =
      benchmark::Counter(views, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void BM_Reference(benchmark::State& state) {
  SurveyedModel const model = original(int(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(reference(model, {}));
  count_views(state, 32);
}

/// Arguments: triangles, pixels, samples per pixel and axis.
void draw(benchmark::State& state, Kind kind) {
  MeasureOptions options;
  options.size = int(state.range(1));
  options.supersample = int(state.range(2));
  Reference const made = reference(original(20'000), options);
  SurveyedModel const model = thumbnail(kind, int(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(pictures(model, made));
  count_views(state, 32);
}

void BM_PicturesFlat(benchmark::State& state) { draw(state, Kind::flat); }
void BM_PicturesTextured(benchmark::State& state) { draw(state, Kind::textured); }

void BM_Compare(benchmark::State& state) {
  MeasureOptions options;
  options.size = int(state.range(0));
  Reference const made = reference(original(20'000), options);
  std::vector<Image> const drawn = pictures(thumbnail(Kind::flat, 3000), made);
  for (auto _ : state) benchmark::DoNotOptimize(compare(made.pictures, drawn));
  count_views(state, 32);
}

void sizes(benchmark::internal::Benchmark* bench) {
  for (int triangles : {2'000, 5'000, 20'000}) bench->Args({triangles, 200, 4});
  bench->Args({5'000, 400, 2})->Args({5'000, 200, 2});
  bench->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();
}

BENCHMARK(BM_Reference)->Apply(scans);
BENCHMARK(BM_PicturesFlat)->Apply(sizes);
BENCHMARK(BM_PicturesTextured)->Apply(sizes);
BENCHMARK(BM_Compare)->Arg(200)->Arg(400)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

}  // namespace
}  // namespace vitrine::perf

BENCHMARK_MAIN();
