// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Cuts a light mesh into disk-like charts.
/// Source: Limper et al. 2015, section 3.2, after Levy et al. 2002, "Least Squares Conformal Maps for Automatic Texture
/// Atlas Generation", section 4: features, distance to features, growth from its maxima.

#include "stages/data.h"
#include "stages/options.h"

namespace vitrine {

struct SegmentOptions {
  double feature_share = 0.05;  ///< share of the edges, those with the sharpest dihedral angles, that are features
  int min_chart_faces = 8;      ///< smaller charts are merged into a neighbour where a disk remains

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(self.feature_share,
          Field{"feature-share", "of the edges", "edges with the sharpest dihedral angles that bound charts", 0, 1});
    visit(self.min_chart_faces,
          Field{"min-chart-faces", "faces", "merge charts smaller than this into a neighbour", 1, 1e6});
  }
};

/// Out:    every face in exactly one chart; each chart by itself a topological disk (connected over edges that two of
///         its faces run through in opposite directions, Euler characteristic 1, one boundary loop, no pinched vertex);
///         deterministic. Charts are merged while the union stays a disk and flat enough to unfold with little stretch:
///         fewer, larger charts waste fewer texels. Where more than two faces meet at an edge, the flattest pairs
///         belong together, so that a non-manifold mesh falls into sheets and not into single faces.
/// Errors: none for a mesh that passes check(); a single triangle is a disk.
/// Cost:   O(f log f).
ChartedMesh segment(TriMesh const& mesh, SegmentOptions const& options = {});

}  // namespace vitrine
