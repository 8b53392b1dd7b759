// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Shortens the seams between charts.

#include "stages/chart_topology.h"

namespace vitrine {

/// Moves faces across seams while that makes a seam shorter and both charts stay disks: single faces that the other
/// chart holds on two sides, and pairs around a vertex at which the seam takes a detour. No chart vanishes.
void straighten(TriMesh const& mesh, FaceAdjacency const& adjacency, std::vector<std::uint32_t>& face_charts);

}  // namespace vitrine
