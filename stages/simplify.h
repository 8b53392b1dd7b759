// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Quadric edge collapse.
/// Source: Garland & Heckbert 1997, "Surface Simplification Using Quadric Error Metrics"; Limper et al. 2015,
/// section 3.1.

#include "stages/data.h"
#include "stages/options.h"

#include <span>

namespace vitrine {

enum class Decimator {
  optimal,  ///< our own: each collapse places its vertex where the quadric is least
  openmesh  ///< the paper's: OpenMesh's half-edge collapse with its quadric and normal flipping modules
};
template <>
struct EnumNames<Decimator> {
  static constexpr std::array<std::string_view, 2> names{"optimal", "openmesh"};
};

struct SimplifyOptions {
  int triangles = 3000;
  double max_error = 1.0;  ///< share of the bounding box's diagonal
  Decimator decimator = Decimator::optimal;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(self.triangles,
          Field{"triangles", "triangles", "simplify each model to at most this many; 0: the search decides", 0, 1e6});
    visit(self.max_error,
          Field{"stop-at-error", "box diagonals", "stop before a collapse moves the surface farther than this", 0, 1});
    visit(self.decimator,
          Field{"decimator", "", "edge collapse: our own with optimal placement, or OpenMesh's as in the paper"});
  }
};

/// Colours that faces should keep apart where they differ.
struct VertexColours {
  std::span<V3f const> values;  ///< one per vertex of the mesh, as pictures are compared: sRGB in [0,1]
  double weight = 0;            ///< half diagonals of the bounding box that a difference of 1 counts as; 0: not at all
};

/// Simplifies a welded mesh to options.triangles faces.
/// In:     n vertices, f faces; may be open, non-manifold, of many components. A small component vanishes once that
///         harms less than to coarsen the rest: it counts as a move by its own size. Dust does not eat the budget.
/// Out:    at most options.triangles faces, or a stop reason; no face flipped, none without area; boundaries held by
///         perpendicular planes; topology kept while that reaches the target, and where it is manifold; the mesh is
///         compact (no unused vertex) and not empty.
/// Errors: none beyond std::bad_alloc: what cannot be collapsed stays, and `stop` says so.
/// Cost:   near O(n): some 110 bytes per face; 0.6 to 1 million faces a second on one core. OpenMesh: a twentieth of
///         that, and quadratic in the faces around one vertex. With colours, which our own decimator alone heeds, twice
///         that, and `error` holds the colours' part too.
SimplifiedMesh simplify(TriMesh const& mesh, SimplifyOptions const& options = {}, VertexColours const& colours = {});

}  // namespace vitrine
