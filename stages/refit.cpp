// SPDX-License-Identifier: Apache-2.0
#include "stages/refit.h"

#include "stages/face_grid.h"
#include "stages/fit_energy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace vitrine {
namespace {

using Imath::V3i;
using V3l = Imath::Vec3<std::int64_t>;

constexpr double kLeastCosine = 0.5;  // a face turns by less than 60 degrees

V3d area_vector(std::vector<V3f> const& positions, Triangle const& t) {
  V3d const a(positions[t[0]]);
  return (V3d(positions[t[1]]) - a).cross(V3d(positions[t[2]]) - a);
}

bool keeps_side(V3d const& before, V3d const& after) {
  return after.length2() > 0 && before.dot(after) >= kLeastCosine * before.length() * after.length();
}

/// Puts the corners of faces that look elsewhere than in `before` back to `places`, until there are none.
void put_turned_back(TriMesh& mesh, TriMesh const& before, std::vector<V3f> const& places) {
  for (bool turned = true; turned;) {
    turned = false;
    for (Triangle const& t : mesh.triangles) {
      if (keeps_side(area_vector(before.positions, t), area_vector(mesh.positions, t))) continue;
      for (std::uint32_t v : t) {
        turned = turned || mesh.positions[v] != places[v];
        mesh.positions[v] = places[v];
      }
    }
  }
}

/// Descends from the nearest places of the grid to better ones.
class Rounding {
 public:
  Rounding(TriMesh const& mesh, Grid const& grid, FitEnergy const& energy)
      : mesh_(mesh),
        grid_(grid),
        energy_(energy),
        moves_(mesh.positions.size()),
        step_(double(grid.range) / grid_.last()) {
    for (std::size_t v = 0; v < moves_.size(); ++v) {
      codes_.push_back(grid_.code(mesh.positions[v]));
      moves_[v] = move_to(v, codes_[v]);
    }
  }

  void descend(int sweeps) {
    bool moved = true;
    for (int sweep = 0; sweep < sweeps && moved; ++sweep) {
      moved = false;
      for (std::uint32_t v = 0; v < moves_.size(); ++v) moved = improve(v) || moved;
    }
  }

  TriMesh result() const {
    TriMesh mesh = mesh_;
    for (std::size_t v = 0; v < codes_.size(); ++v) mesh.positions[v] = grid_.value(codes_[v]);
    return mesh;
  }

 private:
  V3d move_to(std::size_t v, V3i const& code) const {
    return (V3d(grid_.value(code)) - V3d(mesh_.positions[v])) / energy_.scale();
  }

  bool improve(std::uint32_t v) {
    FitEnergy::Local const local = energy_.around(v, moves_);
    double const step = step_ / energy_.scale();
    V3i best(0);
    double least = 0;
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z) {
          V3i const by(x, y, z);
          double const energy = local(V3d(by) * step);
          if (energy < least && allowed(v, codes_[v] + by)) least = energy, best = by;
        }
    if (best == V3i(0)) return false;
    codes_[v] += best;
    moves_[v] = move_to(v, codes_[v]);
    return true;
  }

  /// On the grid, and no face around turns over.
  bool allowed(std::uint32_t v, V3i const& code) const {
    for (int k = 0; k < 3; ++k)
      if (code[k] < 0 || code[k] > grid_.last()) return false;
    auto const faces = energy_.faces_of(v);
    return std::all_of(faces.begin(), faces.end(), [&](std::uint32_t f) {
      Triangle const& t = mesh_.triangles[f];
      std::array<V3l, 3> corners;
      for (int k = 0; k < 3; ++k) corners[k] = V3l(t[k] == v ? code : codes_[t[k]]);
      V3d const after((corners[1] - corners[0]).cross(corners[2] - corners[0]));
      return keeps_side(area_vector(mesh_.positions, t), after);
    });
  }

  TriMesh const& mesh_;
  GridCodes grid_;
  FitEnergy const& energy_;
  std::vector<V3i> codes_;
  std::vector<V3d> moves_;
  double step_;
};

}  // namespace

TriMesh refit(TriMesh const& mesh, SurfaceSamples const& samples, RefitOptions const& options) {
  TriMesh fitted = mesh;
  double const farthest = usual_reach(mesh) / 2;
  for (int i = 0; i < options.iterations; ++i) {
    FitEnergy const energy(fitted, samples, options.facet_weight);
    std::vector<V3d> const moves = energy.least();
    std::vector<V3f> const places = fitted.positions;
    for (std::size_t v = 0; v < moves.size(); ++v) {
      V3d const move = moves[v] * energy.scale();
      fitted.positions[v] += V3f(move * std::min(1.0, farthest / move.length()));
    }
    put_turned_back(fitted, mesh, places);
  }
  return fitted;
}

QuantizedMesh round_to_grid(TriMesh const& mesh, Grid const& grid, SurfaceSamples const& samples,
                            RefitOptions const& options) {
  constexpr int kSweeps = 6;
  FitEnergy const energy(mesh, samples, options.facet_weight);
  Rounding rounding(mesh, grid, energy);
  rounding.descend(kSweeps);
  return quantize(rounding.result(), grid);
}

}  // namespace vitrine
