// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What benchmarks share: scans and light meshes of doubling sizes, and how rates are counted. VITRINE_PERF=full in the
/// environment goes on to 28 million triangles where a stage sees the whole original.

#include "stages/clean.h"
#include "stages/simplify.h"
#include "stages/surface.h"
#include "tests/support/meshes.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <string_view>

namespace vitrine::perf {

/// A bumpy sphere of about this many triangles.
inline TriMesh mesh_of(std::int64_t triangles) {
  int const stacks = int(std::sqrt(double(triangles) / 4));
  return test::bumpy_sphere(2 * stacks, stacks);
}

/// One as it is read, with a colour per vertex.
inline SourceModel scan_of(std::int64_t triangles) { return test::painted_model(mesh_of(triangles)); }

/// With its tree, which the first ray makes.
inline SurveyedModel surveyed(SourceModel model) {
  SurveyedModel made = survey(std::make_shared<SourceModel const>(std::move(model)));
  benchmark::DoNotOptimize(made.scene.first_hit({{9, 0, 0}, {-1, 0, 0}}));
  return made;
}

/// What a trial begins with: a scan of 125,000 triangles, simplified.
inline TriMesh const& light_mesh(std::int64_t triangles) {
  static std::map<std::int64_t, TriMesh> made;
  if (!made.contains(triangles)) {
    SimplifyOptions options;
    options.triangles = int(triangles);
    made[triangles] = simplify(mesh_of(125'000), options).mesh;
  }
  return made[triangles];
}

inline void count_triangles(benchmark::State& state, std::size_t triangles) {
  state.counters["triangles per CPU second"] =
      benchmark::Counter(double(triangles), benchmark::Counter::kIsIterationInvariantRate);
}

inline void in_milliseconds(benchmark::internal::Benchmark* bench) {
  bench->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->MinTime(0.2);
}

/// Of whole originals.
inline void scans(benchmark::internal::Benchmark* bench) {
  char const* const asked = std::getenv("VITRINE_PERF");
  std::int64_t const most = asked && std::string_view(asked) == "full" ? 28'000'000 : 1'000'000;
  for (std::int64_t triangles = 62'500; triangles <= most; triangles *= 2) bench->Arg(triangles);
  if (most > 1'000'000) bench->Arg(most);
  in_milliseconds(bench);
}

/// Of thumbnails.
inline void light_meshes(benchmark::internal::Benchmark* bench) {
  for (std::int64_t triangles = 500; triangles <= 8'000; triangles *= 2) bench->Arg(triangles);
  in_milliseconds(bench);
}

}  // namespace vitrine::perf
