// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The closest face to a point that lies near a light mesh: ten times as fast there as a tree.

#include "stages/closest_point.h"
#include "stages/data.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace vitrine {

/// A uniform grid whose cells list the faces that touch them. Immutable; any thread.
class FaceGrid {
 public:
  struct Match {
    std::uint32_t face;
    Barycentric at;
  };

  /// Faces may be edges, two of their corners being the same vertex.
  FaceGrid(TriMesh const& mesh, float reach);

  /// The closest point, nearer than reach(), on a face whose normal makes an acute angle with `side`; `side` zero: any
  /// face. The answer is found sooner if `hint` is a face close by.
  std::optional<Match> closest(V3f const& point, V3f const& side, std::uint32_t hint = 0) const;

  float reach() const { return reach_; }

 private:
  struct Face {
    V3f corner, b, c;              ///< b, c: from the corner to the others
    V3f normal;                    ///< unit; zero without area
    V3f slope_u, slope_v;          ///< of the barycentric weights of b and c over space
    std::array<float, 3> slopes2;  ///< squared slopes of the weights of b, c and the corner
  };

  static Face face(V3f const& corner, V3f const& b, V3f const& c);

  void improve(std::uint32_t index, V3f const& point, V3f const& side, std::optional<Match>& best, float& least) const;
  struct Cells {
    Imath::V3i from, to;
  };
  std::size_t index(Imath::V3i const& cell) const {
    return (std::size_t(cell.z) * cells_.y + cell.y) * cells_.x + cell.x;
  }
  Cells cells_between(V3f const& low, V3f const& high) const;  ///< both within, and in the grid
  template <class Visit>
  void for_cells(Face const& face, Visit const& visit) const;

  V3f origin_{0, 0, 0};
  float reach_ = 0, cell_ = 1;
  Imath::V3i cells_{0, 0, 0};
  std::vector<Face> faces_;
  std::vector<std::uint32_t> first_;   ///< per cell, one more than cells: where its list begins
  std::vector<std::uint32_t> listed_;  ///< faces, ascending within a cell
};

/// Half of a typical edge: as far as a light mesh is from what it stands for, where it does.
float usual_reach(TriMesh const& mesh);

}  // namespace vitrine
