// SPDX-License-Identifier: Apache-2.0
#include "stages/fit_energy.h"

#include "stages/edges.h"
#include "stages/face_grid.h"
#include "stages/parallel.h"

#include <algorithm>
#include <cmath>

namespace vitrine {
namespace {

// Chosen by image error on scans at 1,500 to 20,000 faces. More of the first two costs up to a tenth of what refitting
// gains; half or twice the third 3 %.
constexpr double kAllDirections = 0.001;  // share of the whole distance
constexpr double kPull = 0.0003;          // share of an average vertex's samples
constexpr double kSlope = 0.07;           // squared, in squared lengths per area of the face: what a radian counts as
constexpr double kLine = 10;              // samples that one on a ridge or outline counts as
constexpr double kTangledPull = 1;        // as kPull, where more than two faces meet
constexpr std::size_t kGrain = 1024;
constexpr std::uint32_t kNone = ~std::uint32_t{0};

constexpr std::array<std::array<int, 3>, 3> kBlock{{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}}};  // where Form::h has i, j

struct Matches {
  std::vector<FaceGrid::Match> of_sample;
  std::vector<std::uint32_t> first, samples;  ///< per face: its samples, ascending
};

Matches match(TriMesh const& mesh, SurfaceSamples const& samples, FaceGrid const& grid) {
  Matches matches{
      std::vector<FaceGrid::Match>(samples.points.size()), std::vector<std::uint32_t>(mesh.triangles.size() + 1), {}};
  parallel_blocks(samples.points.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    std::uint32_t hint = 0;  // neighbours in the list are neighbours on the surface, mostly
    for (std::size_t s = begin; s < end; ++s) {
      matches.of_sample[s] =
          grid.closest(samples.points[s], samples.normals[s], hint).value_or(FaceGrid::Match{kNone, {}});
      if (matches.of_sample[s].face != kNone) hint = matches.of_sample[s].face;
    }
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

/// `weight` times the squared distance from a line of this unit direction.
Symmetric across(V3d const& along, double weight) {
  Symmetric metric{weight, 0, 0, weight, 0, weight};
  metric.add(Symmetric::outer(along), -weight);
  return metric;
}

double dot(std::vector<V3d> const& a, std::vector<V3d> const& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
  return sum;
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
      pulls_(mesh.positions.size()),
      outline_(outline(mesh)) {
  list_faces();
  FaceGrid const grid(mesh, usual_reach(mesh));
  add_samples(samples, grid);
  add_ridges(samples, grid);
  add_outline(samples);
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

void FitEnergy::Form::add(std::array<double, 3> const& share, Symmetric const& metric, V3d const& gap) {
  V3d const pull = metric * gap;
  for (int k = 0; k < 3; ++k) {
    h[k].add(metric, share[k] * share[k]);
    h[3 + k].add(metric, share[k] * share[(k + 1) % 3]);
    g[k] += pull * share[k];
  }
}

void FitEnergy::add_samples(SurfaceSamples const& samples, FaceGrid const& grid) {
  Matches const matches = match(mesh_, samples, grid);
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
      form.add({1.0 - u - v, u, v}, metric, gap);
      sums_of_normals_[f] += V3d(samples.shading[s]);
    }
    counts_[f] = matches.first[f + 1] - matches.first[f];
  });
}

void FitEnergy::add_ridges(SurfaceSamples const& samples, FaceGrid const& grid) {
  for (auto const& [point, along, normal] : samples.ridges) {
    auto const match = grid.closest(point, normal);
    if (!match) continue;
    auto const& [a, b, c] = mesh_.triangles[match->face];
    auto const [u, v] = match->at;
    V3d const place = interpolate(V3d(mesh_.positions[a]), V3d(mesh_.positions[b]), V3d(mesh_.positions[c]), match->at);
    forms_[match->face].add({1.0 - u - v, u, v}, across(V3d(along), kLine), (V3d(point) - place) / scale_);
  }
}

/// Points of the original's outline against the mesh's, across it.
void FitEnergy::add_outline(SurfaceSamples const& samples) {
  std::vector<FaceEdge> const& open = outline_.open;
  if (open.empty() || samples.outline.empty()) return;
  TriMesh edges{mesh_.positions, {}};
  for (auto const& [face, corner] : open) {
    Triangle const& t = mesh_.triangles[face];
    edges.triangles.push_back({t[corner], t[(corner + 1) % 3], t[corner]});
  }
  FaceGrid const grid(edges, usual_reach(mesh_));
  std::vector<FaceGrid::Match> matches(samples.outline.size());
  parallel_for(matches.size(), kGrain, [&](std::size_t s) {
    matches[s] = grid.closest(samples.outline[s], V3f(0)).value_or(FaceGrid::Match{kNone, {}});
  });
  for (std::size_t s = 0; s < matches.size(); ++s) {
    if (matches[s].face == kNone) continue;
    auto const [face, corner] = open[matches[s].face];
    Triangle const& t = edges.triangles[matches[s].face];
    V3d const from(mesh_.positions[t[0]]), along = V3d(mesh_.positions[t[1]]) - from;
    double const at = matches[s].at.u;
    std::array<double, 3> share{0, 0, 0};
    share[corner] = 1 - at;
    share[(corner + 1) % 3] = at;
    forms_[face].add(share, across(along.normalized(), kLine), (V3d(samples.outline[s]) - from - along * at) / scale_);
  }
}

void FitEnergy::add_facets(double facet_weight) {
  for (std::size_t f = 0; f < forms_.size(); ++f) {
    if (!(sums_of_normals_[f].length2() > 0)) continue;
    V3d const normal = sums_of_normals_[f].normalized();
    Symmetric const slope = Symmetric::outer(normal);
    std::array<V3d, 3> edges;
    Triangle const& t = mesh_.triangles[f];
    for (int k = 0; k < 3; ++k) edges[k] = (V3d(mesh_.positions[t[(k + 1) % 3]]) - V3d(mesh_.positions[t[k]])) / scale_;
    double const area = edges[0].cross(edges[1]).length() / 2;
    for (int k = 0; k < 3; ++k) {
      double const weight = facet_weight * counts_[f] * kSlope * area / edges[k].length2();
      std::array<double, 3> share{0, 0, 0};
      share[k] = 1, share[(k + 1) % 3] = -1;
      Symmetric metric;
      metric.add(slope, weight);
      forms_[f].add(share, metric, edges[k]);
    }
  }
}

void FitEnergy::add_pulls() {
  double matched = 0;
  for (std::uint32_t count : counts_) matched += count;
  double const samples = std::max(1.0, matched) / double(mesh_.positions.size());
  std::vector<double> pulls(pulls_.size(), kPull);
  for (auto const& [face, corner] : outline_.tangled)
    for (std::uint32_t k : {corner, (corner + 1) % 3}) pulls[mesh_.triangles[face][k]] = kTangledPull;
  for (std::size_t v = 0; v < pulls.size(); ++v) {
    double const pull = pulls[v] * samples;
    pulls_[v] = {pull, 0, 0, pull, 0, pull};
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
  constexpr double kGood = 1e-8;  // of the first residual, squared
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
