// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Huge scans, thinned before anything else looks at them: what lies within one cell of a grid, and hangs together
/// there, becomes one vertex.

#include "stages/data.h"
#include "stages/options.h"

#include <optional>

namespace vitrine {

struct ClusterOptions {
  int above = 2'000'000;
  int triangles = 600'000;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(self.above, Field{"cluster-above", "triangles",
                            "larger scans without textures are first thinned: what hangs together within a small cell "
                            "becomes one vertex",
                            1e4, 2e9});
    visit(self.triangles, Field{"cluster-triangles", "triangles", "about so many are left of these", 1e4, 1e8});
  }
};

/// Source: Rossignac & Borrel 1993, "Multi-Resolution 3D Approximations for Rendering Complex Scenes", but two sheets
///         in one cell stay two: only vertices that edges within the cell connect become one, by union-find over all
///         threads (Jaiganesh & Burtscher 2018, "A High-Performance Connected Components Implementation for GPUs").
/// In:     a model as read: positions may be NaN, vertices at one place need not be one. Models with images or several
///         materials are left alone.
/// Out:    positions, colours and normals are the means over each cluster's vertices, so that what is baked from them
///         is filtered already. Faces may be repeated or without area: clean() comes next. Nothing where the model is
///         not to be clustered, or is no surface at that scale (a heap of parts each smaller than a cell).
/// Cost:   linear: 30 ns a triangle, four times as long where vertices and faces are in random order; 8 bytes a vertex.
///         The same bytes at any number of threads.
std::optional<SourceModel> cluster(SourceModel const& source, ClusterOptions const& options = {});

}  // namespace vitrine
