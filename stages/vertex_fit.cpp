// SPDX-License-Identifier: Apache-2.0
#include "stages/vertex_fit.h"

#include "stages/face_grid.h"
#include "stages/parallel.h"

#include <algorithm>
#include <cmath>

namespace vitrine {
namespace {

constexpr std::size_t kGrain = 1024;
constexpr std::uint32_t kNone = ~std::uint32_t{0};

/// What a vertex that shows next to nothing may take from such a fit is noise; this much always goes to the mean.
constexpr double kLeastSmoothing = 0.01;

double dot(std::vector<V3d> const& a, std::vector<V3d> const& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
  return sum;
}

}  // namespace

VertexFit::VertexFit(TriMesh const& mesh, SurfaceSamples const& samples, std::span<float const> weights)
    : mesh_(mesh),
      first_(mesh.triangles.size() + 1, 0),
      forms_(mesh.triangles.size()),
      row_sums_(mesh.positions.size(), 0),
      own_(mesh.positions.size(), 0),
      seen_(mesh.positions.size(), false) {
  FaceGrid const grid(mesh, usual_reach(mesh));
  std::vector<FaceGrid::Match> matches(samples.points.size());
  parallel_for(matches.size(), kGrain, [&](std::size_t s) {
    matches[s] = FaceGrid::Match{kNone, {}};
    if (!weights.empty() && !(weights[s] > 0)) return;
    if (auto const found = grid.closest(samples.points[s], samples.normals[s])) matches[s] = *found;
  });
  for (FaceGrid::Match const& match : matches)
    if (match.face != kNone) ++first_[match.face];
  std::uint32_t sum = 0;
  for (std::uint32_t& first : first_) first = sum += first;
  shares_.resize(sum);
  for (std::size_t s = matches.size(); s-- > 0;) {
    auto const& [face, at] = matches[s];
    if (face == kNone) continue;
    shares_[--first_[face]] = {std::uint32_t(s), {1 - at.u - at.v, at.u, at.v}, weights.empty() ? 1 : weights[s]};
  }
  parallel_for(forms_.size(), kGrain, [&](std::size_t f) {
    for (std::uint32_t i = first_[f]; i < first_[f + 1]; ++i)
      for (int k = 0; k < 3; ++k) {
        double const part = double(shares_[i].weight) * shares_[i].of[k];
        forms_[f].diagonal[k] += part * shares_[i].of[k];
        forms_[f].across[k] += part * shares_[i].of[(k + 1) % 3];
      }
  });
  for (std::size_t f = 0; f < forms_.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      Form const& form = forms_[f];
      std::uint32_t const v = mesh.triangles[f][k];
      own_[v] += form.diagonal[k];
      row_sums_[v] += form.diagonal[k] + form.across[k] + form.across[(k + 2) % 3];
    }
  for (std::size_t v = 0; v < seen_.size(); ++v) seen_[v] = row_sums_[v] > 0;
}

/// `diagonal` and `coupling` times what M has off its diagonal.
std::vector<V3d> VertexFit::times(std::vector<V3d> const& values, std::vector<double> const& diagonal,
                                  double coupling) const {
  std::vector<V3d> out(values.size());
  for (std::size_t v = 0; v < values.size(); ++v) out[v] = values[v] * diagonal[v];
  for (std::size_t f = 0; f < forms_.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      std::uint32_t const a = mesh_.triangles[f][k], b = mesh_.triangles[f][(k + 1) % 3];
      double const across = coupling * forms_[f].across[k];
      out[a] += values[b] * across;
      out[b] += values[a] * across;
    }
  return out;
}

std::vector<V3f> VertexFit::operator()(std::span<V3f const> values, std::span<V3f const> otherwise,
                                       double smoothing) const {
  constexpr int kMostSteps = 60;
  constexpr double kGood = 1e-8;  // of the first residual, squared
  std::size_t const n = row_sums_.size();
  double const smooth = std::max(smoothing, kLeastSmoothing), coupling = 1 - smooth;
  std::vector<double> diagonal(n);
  for (std::size_t v = 0; v < n; ++v)
    diagonal[v] = seen_[v] ? coupling * own_[v] + smooth * row_sums_[v] : 1;  // unseen ones are alone

  std::vector<V3d> wanted(n, V3d(0)), fitted(n, V3d(0));
  for (std::size_t f = 0; f < forms_.size(); ++f)
    for (std::uint32_t i = first_[f]; i < first_[f + 1]; ++i)
      for (int k = 0; k < 3; ++k)
        wanted[mesh_.triangles[f][k]] +=
            V3d(values[shares_[i].sample]) * (double(shares_[i].weight) * shares_[i].of[k]);
  for (std::size_t v = 0; v < n; ++v) {  // begin with the means: constants are then exact
    if (!seen_[v]) wanted[v] = V3d(otherwise[v]);
    fitted[v] = wanted[v] / (seen_[v] ? row_sums_[v] : 1);
  }

  std::vector<V3d> residual = times(fitted, diagonal, coupling), scaled(n), direction;
  for (std::size_t v = 0; v < n; ++v) residual[v] = wanted[v] - residual[v];
  auto const precondition = [&] {
    for (std::size_t v = 0; v < n; ++v) scaled[v] = residual[v] / diagonal[v];
    return dot(residual, scaled);
  };
  double size = precondition();
  double const enough = std::max(kGood * size, 1e-12);
  direction = scaled;
  for (int step = 0; step < kMostSteps && size > enough; ++step) {
    std::vector<V3d> const image = times(direction, diagonal, coupling);
    double const along = size / dot(direction, image);
    for (std::size_t v = 0; v < n; ++v) {
      fitted[v] += direction[v] * along;
      residual[v] -= image[v] * along;
    }
    double const before = size;
    size = precondition();
    for (std::size_t v = 0; v < n; ++v) direction[v] = scaled[v] + direction[v] * (size / before);
  }
  std::vector<V3f> result;
  result.reserve(n);
  for (V3d const& value : fitted) result.emplace_back(value);
  return result;
}

}  // namespace vitrine
