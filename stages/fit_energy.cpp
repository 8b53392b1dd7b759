// SPDX-License-Identifier: Apache-2.0
#include "stages/fit_energy.h"

#include "stages/face_grid.h"
#include "stages/parallel.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace vitrine {
namespace {

constexpr double kAllDirections = 0.05;  // share of the whole distance
constexpr double kPull = 0.01;           // share of an average vertex's samples
constexpr double kHold = 1;              // likewise, on boundaries
constexpr double kTilt = 0.01;           // radii that a radian counts as
constexpr std::size_t kGrain = 1024;
constexpr std::uint32_t kNone = ~std::uint32_t{0};

constexpr std::array<std::array<int, 3>, 3> kBlock{{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}}};  // where Form::h has i, j

struct Matches {
  std::vector<FaceGrid::Match> of_sample;
  std::vector<std::uint32_t> first, samples;  ///< per face: its samples, ascending
};

Matches match(TriMesh const& mesh, SurfaceSamples const& samples) {
  FaceGrid const grid(mesh);
  Matches matches{std::vector<FaceGrid::Match>(samples.points.size()), std::vector<std::uint32_t>(mesh.triangles.size() + 1),
                  {}};
  parallel_for(samples.points.size(), kGrain, [&](std::size_t s) {
    matches.of_sample[s] = grid.closest(samples.points[s], samples.normals[s]).value_or(FaceGrid::Match{kNone, {}});
  });
  std::uint32_t sum = 0;
  for (FaceGrid::Match const& m : matches.of_sample)
    if (m.face != kNone) ++matches.first[m.face], ++sum;
  matches.samples.resize(sum);
  sum = 0;
  for (std::uint32_t& first : matches.first) first = sum += first;
  for (std::size_t s = samples.points.size(); s-- > 0;)
    if (std::uint32_t const face = matches.of_sample[s].face; face != kNone)
      matches.samples[--matches.first[face]] = std::uint32_t(s);
  return matches;
}

double dot(std::vector<V3d> const& a, std::vector<V3d> const& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
  return sum;
}

/// Vertices of edges that have not exactly two faces.
std::vector<bool> on_outline(TriMesh const& mesh) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (Triangle const& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) edges.push_back(std::minmax(t[k], t[(k + 1) % 3]));
  std::sort(edges.begin(), edges.end());
  std::vector<bool> outline(mesh.positions.size(), false);
  for (auto at = edges.begin(); at != edges.end();) {
    auto const end = std::find_if(at, edges.end(), [&](auto const& edge) { return edge != *at; });
    if (end - at != 2) outline[at->first] = outline[at->second] = true;
    at = end;
  }
  return outline;
}

}  // namespace

V3d Symmetric::solve(V3d const& v) const {
  V3d const row0(yy * zz - yz * yz, xz * yz - xy * zz, xy * yz - xz * yy);  // of the adjugate
  V3d const row1(row0.y, xx * zz - xz * xz, xy * xz - xx * yz);
  V3d const row2(row0.z, row1.z, xx * yy - xy * xy);
  double const determinant = xx * row0.x + xy * row0.y + xz * row0.z;
  return V3d(row0.dot(v), row1.dot(v), row2.dot(v)) / determinant;
}

FitEnergy::FitEnergy(TriMesh const& mesh, SurfaceSamples const& samples, double facet_weight)
    : mesh_(mesh),
      scale_(samples.radius),
      forms_(mesh.triangles.size()),
      sums_of_normals_(mesh.triangles.size(), V3d(0)),
      counts_(mesh.triangles.size(), 0),
      pulls_(mesh.positions.size()) {
  list_faces();
  add_samples(samples);
  add_facets(facet_weight);
  add_pulls();
}

void FitEnergy::list_faces() {
  first_face_.assign(mesh_.positions.size() + 1, 0);
  for (Triangle const& t : mesh_.triangles)
    for (std::uint32_t v : t) ++first_face_[v];
  std::uint32_t sum = 0;
  for (std::uint32_t& first : first_face_) first = sum += first;
  vertex_faces_.resize(sum);
  for (std::size_t f = mesh_.triangles.size(); f-- > 0;)
    for (std::uint32_t v : mesh_.triangles[f]) vertex_faces_[--first_face_[v]] = std::uint32_t(f);
}

void FitEnergy::add_samples(SurfaceSamples const& samples) {
  Matches const matches = match(mesh_, samples);
  parallel_for(forms_.size(), kGrain, [&](std::size_t f) {
    Form& form = forms_[f];
    auto const& [a, b, c] = mesh_.triangles[f];
    V3d const corner(mesh_.positions[a]), to_b = V3d(mesh_.positions[b]) - corner,
                                          to_c = V3d(mesh_.positions[c]) - corner;
    for (std::uint32_t i = matches.first[f]; i < matches.first[f + 1]; ++i) {
      std::uint32_t const s = matches.samples[i];
      auto const [u, v] = matches.of_sample[s].at;
      V3d const normal(samples.normals[s]);
      V3d const gap = (V3d(samples.points[s]) - corner - to_b * u - to_c * v) / scale_;
      Symmetric metric = Symmetric::outer(normal);
      metric.xx += kAllDirections, metric.yy += kAllDirections, metric.zz += kAllDirections;
      V3d const pull = metric * gap;
      std::array<double, 3> const share{1.0 - u - v, u, v};
      for (int k = 0; k < 3; ++k) {
        form.h[k].add(metric, share[k] * share[k]);
        form.h[3 + k].add(metric, share[k] * share[(k + 1) % 3]);
        form.g[k] += pull * share[k];
      }
      sums_of_normals_[f] += V3d(samples.shading[s]);
    }
    counts_[f] = matches.first[f + 1] - matches.first[f];
  });
}

void FitEnergy::add_facets(double facet_weight) {
  for (std::size_t f = 0; f < forms_.size(); ++f) {
    if (!(sums_of_normals_[f].length2() > 0)) continue;
    V3d const normal = sums_of_normals_[f].normalized();
    Symmetric const along = Symmetric::outer(normal);
    for (int k = 0; k < 3; ++k) {
      int const next = (k + 1) % 3;
      Triangle const& t = mesh_.triangles[f];
      V3d const edge = (V3d(mesh_.positions[t[next]]) - V3d(mesh_.positions[t[k]])) / scale_;
      double const weight = facet_weight * counts_[f] * kTilt * kTilt / edge.length2();
      Form& form = forms_[f];
      form.h[k].add(along, weight);
      form.h[next].add(along, weight);
      form.h[3 + k].add(along, -weight);
      V3d const slope = normal * (weight * normal.dot(edge));
      form.g[next] -= slope;
      form.g[k] += slope;
    }
  }
}

void FitEnergy::add_pulls() {
  std::vector<bool> const outline = on_outline(mesh_);
  double matched = 0;
  for (std::uint32_t count : counts_) matched += count;
  double const samples = std::max(1.0, matched) / double(mesh_.positions.size());
  for (std::uint32_t v = 0; v < pulls_.size(); ++v) {
    double const pull = kPull * samples;
    pulls_[v] = {pull, 0, 0, pull, 0, pull};
    if (!outline[v]) continue;
    V3d normal(0);
    for (std::uint32_t f : faces_of(v)) normal += sums_of_normals_[f];
    double const hold = kHold * samples;
    pulls_[v].add({1, 0, 0, 1, 0, 1}, hold);
    if (normal.length2() > 0) pulls_[v].add(Symmetric::outer(normal.normalized()), -hold);
  }
}

double FitEnergy::operator()(std::vector<V3d> const& moves) const {
  double energy = 0;
  for (std::size_t f = 0; f < forms_.size(); ++f)
    for (int i = 0; i < 3; ++i) {
      V3d const& move = moves[mesh_.triangles[f][i]];
      V3d pull = forms_[f].g[i] * -2.0;
      for (int j = 0; j < 3; ++j) pull += forms_[f].h[kBlock[i][j]] * moves[mesh_.triangles[f][j]];
      energy += pull.dot(move);
    }
  for (std::size_t v = 0; v < moves.size(); ++v) energy += (pulls_[v] * moves[v]).dot(moves[v]);
  return energy;
}

FitEnergy::Local FitEnergy::around(std::uint32_t vertex, std::vector<V3d> const& moves) const {
  Local local{pulls_[vertex], pulls_[vertex] * moves[vertex] * -1.0};
  for (std::uint32_t f : faces_of(vertex)) {
    Triangle const& t = mesh_.triangles[f];
    int const i = t[0] == vertex ? 0 : t[1] == vertex ? 1 : 2;
    local.a.add(forms_[f].h[i], 1);
    local.b += forms_[f].g[i];
    for (int j = 0; j < 3; ++j) local.b -= forms_[f].h[kBlock[i][j]] * moves[t[j]];
  }
  return local;
}

/// Half the gradient's part that depends on the moves.
std::vector<V3d> FitEnergy::times(std::vector<V3d> const& moves) const {
  std::vector<V3d> out(moves.size());
  for (std::size_t v = 0; v < moves.size(); ++v) out[v] = pulls_[v] * moves[v];
  for (std::size_t f = 0; f < forms_.size(); ++f) {
    auto const& [a, b, c] = mesh_.triangles[f];
    auto const& h = forms_[f].h;
    out[a] += h[0] * moves[a] + h[3] * moves[b] + h[5] * moves[c];
    out[b] += h[3] * moves[a] + h[1] * moves[b] + h[4] * moves[c];
    out[c] += h[5] * moves[a] + h[4] * moves[b] + h[2] * moves[c];
  }
  return out;
}

std::vector<V3d> FitEnergy::least() const {
  constexpr int kMostSteps = 60;
  constexpr double kGood = 1e-6;  // of the first residual, squared
  std::size_t const n = pulls_.size();
  std::vector<Symmetric> diagonal = pulls_;  // preconditioner: each vertex alone
  std::vector<V3d> moves(n, V3d(0)), residual(n, V3d(0)), scaled(n), direction;
  for (std::size_t f = 0; f < forms_.size(); ++f)
    for (int i = 0; i < 3; ++i) {
      diagonal[mesh_.triangles[f][i]].add(forms_[f].h[i], 1);
      residual[mesh_.triangles[f][i]] += forms_[f].g[i];
    }
  auto const precondition = [&] {
    for (std::size_t v = 0; v < n; ++v) scaled[v] = diagonal[v].solve(residual[v]);
    return dot(residual, scaled);
  };
  double size = precondition();
  double const enough = kGood * size;
  direction = scaled;
  for (int step = 0; step < kMostSteps && size > enough; ++step) {
    std::vector<V3d> const image = times(direction);
    double const along = size / dot(direction, image);
    for (std::size_t v = 0; v < n; ++v) {
      moves[v] += direction[v] * along;
      residual[v] -= image[v] * along;
    }
    double const before = size;
    size = precondition();
    for (std::size_t v = 0; v < n; ++v) direction[v] = scaled[v] + direction[v] * (size / before);
  }
  return moves;
}

}  // namespace vitrine
