// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The closest face to a point that lies near a light mesh: ten times as fast there as a tree.

#include "stages/closest_point.h"
#include "stages/data.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace vitrine {

/// A uniform grid whose cells list the faces within `reach()` of any point inside. Immutable; any thread.
class FaceGrid {
 public:
  struct Match {
    std::uint32_t face;
    Barycentric at;
  };

  explicit FaceGrid(TriMesh const& mesh);

  /// The closest point, not farther than reach(), on a face whose normal makes an acute angle with `side`; of equally
  /// close faces the first.
  std::optional<Match> closest(V3f const& point, V3f const& side) const;

  /// Half of a typical edge.
  float reach() const { return reach_; }

 private:
  struct Face {
    V3f corner, b, c, normal;  ///< b, c: from the corner to the others; normal: unit, zero without area
  };

  template <class Visit>
  void for_cells(Face const& face, Visit const& visit) const;

  V3f origin_{0, 0, 0};
  float reach_ = 0, cell_ = 1;
  Imath::V3i cells_{0, 0, 0};
  std::vector<Face> faces_;
  std::vector<std::uint32_t> first_;   ///< per cell, one more than cells: where its list begins
  std::vector<std::uint32_t> listed_;  ///< faces, ascending within a cell
};

}  // namespace vitrine
