// SPDX-License-Identifier: Apache-2.0
#include "stages/detail.h"

#include "stages/face_grid.h"
#include "stages/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

namespace vitrine {
namespace {

constexpr std::size_t kGrain = 1024;
constexpr double kNeighbourhood = 3;  ///< spacings of samples
constexpr double kPrior = 6;          ///< samples' worth of the mean that each face begins with
constexpr float kLeast = 0.5f, kMost = 2;

double area(TriMesh const& mesh, Triangle const& t) {
  V3d const a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
  return (b - a).cross(c - a).length() / 2;
}

double area(TriMesh const& mesh) {
  double sum = 0;
  for (Triangle const& t : mesh.triangles) sum += area(mesh, t);
  return sum;
}

/// For each sample the variance of colour in the cell of space that it lies in.
std::vector<double> variances(SurfaceSamples const& samples, double cell) {
  using Cell = std::array<int, 3>;
  std::size_t const n = samples.points.size();
  std::vector<Cell> cells(n);
  for (std::size_t s = 0; s < n; ++s)
    for (unsigned k = 0; k < 3; ++k) cells[s][k] = int(std::floor(samples.points[s][k] / cell));
  std::vector<std::uint32_t> order(n);
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return std::tie(cells[a], a) < std::tie(cells[b], b); });
  std::vector<double> out(n, 0);
  for (std::size_t begin = 0, end = 0; begin < n; begin = end) {
    V3d sum(0);
    double squares = 0;
    for (; end < n && cells[order[end]] == cells[order[begin]]; ++end) {
      V4f const& c = samples.colours[order[end]];
      sum += V3d(c.x, c.y, c.z);
      squares += V3d(c.x, c.y, c.z).length2();
    }
    double const count = double(end - begin), variance = std::max(0.0, squares / count - (sum / count).length2());
    for (std::size_t i = begin; i < end; ++i) out[order[i]] = variance;
  }
  return out;
}

/// Each face's mean, drawn towards that of all by kPrior.
std::vector<double> face_means(TriMesh const& mesh, SurfaceSamples const& samples, std::vector<double> const& values) {
  FaceGrid const grid(mesh, usual_reach(mesh));
  std::vector<std::optional<FaceGrid::Match>> matches(values.size());
  parallel_for(matches.size(), kGrain,
               [&](std::size_t s) { matches[s] = grid.closest(samples.points[s], samples.normals[s]); });
  double const mean =
      std::accumulate(values.begin(), values.end(), 0.0) / double(std::max<std::size_t>(1, values.size()));
  std::vector<double> sums(mesh.triangles.size(), kPrior * mean), counts(mesh.triangles.size(), kPrior);
  for (std::size_t s = 0; s < values.size(); ++s)
    if (matches[s]) sums[matches[s]->face] += values[s], counts[matches[s]->face] += 1;
  for (std::size_t f = 0; f < sums.size(); ++f) sums[f] /= counts[f];
  return sums;
}

/// By way of the vertices' means.
void smooth(TriMesh const& mesh, std::vector<double>& values) {
  std::vector<double> sums(mesh.positions.size()), counts(mesh.positions.size());
  for (std::size_t f = 0; f < values.size(); ++f)
    for (std::uint32_t v : mesh.triangles[f]) sums[v] += values[f], counts[v] += 1;
  for (std::size_t f = 0; f < values.size(); ++f) {
    values[f] = 0;
    for (std::uint32_t v : mesh.triangles[f]) values[f] += sums[v] / counts[v] / 3;
  }
}

}  // namespace

std::vector<float> detail_lengths(TriMesh const& mesh, SurfaceSamples const& samples) {
  std::vector<float> lengths(mesh.triangles.size(), 1);
  if (samples.colours.empty()) return lengths;
  double const spacing = std::sqrt(area(mesh) / double(samples.points.size()));
  std::vector<double> values = face_means(mesh, samples, variances(samples, kNeighbourhood * spacing));
  smooth(mesh, values);
  double sum = 0, whole = 0;
  for (std::size_t f = 0; f < values.size(); ++f) {
    values[f] = std::sqrt(values[f]);  // the density
    sum += values[f] * area(mesh, mesh.triangles[f]);
    whole += area(mesh, mesh.triangles[f]);
  }
  if (!(sum > 0)) return lengths;
  for (std::size_t f = 0; f < values.size(); ++f)
    lengths[f] = std::clamp(float(std::sqrt(values[f] * whole / sum)), kLeast, kMost);
  return lengths;
}

}  // namespace vitrine
