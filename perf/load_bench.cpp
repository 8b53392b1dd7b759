// SPDX-License-Identifier: Apache-2.0
// What happens once to each original: read, clustered, cleaned, surveyed. Rates should stay level up to 28 million
// triangles (VITRINE_PERF=full, 12 GB of memory).
#include "io/read_model.h"
#include "perf/sizes.h"
#include "stages/cluster.h"

#include <cstring>
#include <string>

namespace vitrine::perf {
namespace {

void append(std::vector<std::byte>& bytes, void const* from, std::size_t count) {
  auto const* first = static_cast<std::byte const*>(from);
  bytes.insert(bytes.end(), first, first + count);
}

/// The mesh as a binary PLY file.
io::Blob ply_of(TriMesh const& mesh) {
  std::string const header =
      "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(mesh.positions.size()) +
      "\nproperty float x\nproperty float y\nproperty float z\nelement face " + std::to_string(mesh.triangles.size()) +
      "\nproperty list uchar int vertex_indices\nend_header\n";
  std::vector<std::byte> bytes;
  append(bytes, header.data(), header.size());
  append(bytes, mesh.positions.data(), mesh.positions.size() * sizeof(V3f));
  for (Triangle const& corners : mesh.triangles) {
    bytes.push_back(std::byte{3});
    append(bytes, corners.data(), sizeof corners);
  }
  return io::own(std::move(bytes));
}

void BM_ReadPly(benchmark::State& state) {
  io::Blob const file = ply_of(mesh_of(state.range(0)));
  io::Resolve const nothing = [](std::string_view) { return std::nullopt; };
  for (auto _ : state) benchmark::DoNotOptimize(io::read_ply(file, nothing));
  count_triangles(state, std::size_t(state.range(0)));
}

void BM_Cluster(benchmark::State& state) {
  SourceModel const scan = scan_of(state.range(0));
  ClusterOptions options;
  options.above = 10'000;
  options.triangles = int(state.range(0) / 4);
  for (auto _ : state) benchmark::DoNotOptimize(cluster(scan, options));
  count_triangles(state, scan.mesh.triangles.size());
}

void BM_Clean(benchmark::State& state) {
  SourceModel const scan = scan_of(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(clean(scan));
  count_triangles(state, scan.mesh.triangles.size());
}

void BM_Weld(benchmark::State& state) {
  SourceModel const scan = scan_of(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(weld(scan));
  count_triangles(state, scan.mesh.triangles.size());
}

void BM_Survey(benchmark::State& state) {
  SourceModel const scan = clean(scan_of(state.range(0))).model;
  for (auto _ : state) benchmark::DoNotOptimize(surveyed(scan));
  count_triangles(state, scan.mesh.triangles.size());
}

BENCHMARK(BM_ReadPly)->Apply(scans);
BENCHMARK(BM_Cluster)->Apply(scans);
BENCHMARK(BM_Clean)->Apply(scans);
BENCHMARK(BM_Weld)->Apply(scans);
BENCHMARK(BM_Survey)->Apply(scans);

}  // namespace
}  // namespace vitrine::perf

BENCHMARK_MAIN();
