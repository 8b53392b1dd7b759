// SPDX-License-Identifier: Apache-2.0
#pragma once
/// One simplification that yields every level: a search tries many triangle counts and pays for one.

#include "stages/collapser.h"
#include "stages/simplify.h"

#include <cstdint>
#include <vector>

namespace vitrine {

/// Holds a mesh of at most `kFinest` faces and the steps from there to the coarsest. Immutable; any thread.
/// Cost: the constructor that of simplify() to a handful of triangles, always with our own decimator; 56 bytes a face
///       kept. A level: O(kFinest), about a millisecond.
class Progression {
 public:
  static constexpr std::size_t kFinest = 65536;

  /// options.triangles is not read: the steps go on until nothing is left to collapse.
  Progression(TriMesh const& mesh, SimplifyOptions const& options, VertexColours const& colours = {});

  /// What simplify() gives for this many triangles, exactly; for more than finest(), finest().
  SimplifiedMesh at(std::size_t triangles) const;

  std::size_t finest() const { return mesh_.triangles.size(); }  ///< triangles of the largest level

 private:
  static constexpr std::uint32_t kStays = ~std::uint32_t{0};

  template <class Q>
  void collapse(TriMesh const& mesh, SimplifyOptions const& options, VertexColours const& colours);

  TriMesh mesh_;
  float error_ = 0;                  ///< of mesh_
  std::vector<CollapseStep> steps_;  ///< in mesh_'s vertices
  std::vector<std::uint32_t> went_;  ///< per face of mesh_: the step that took it, or kStays
  StopReason stop_{};                ///< where the steps end
};

}  // namespace vitrine
