// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Fewer, larger charts.

#include "stages/chart_topology.h"

namespace vitrine {

/// Merges charts two by two, those with the longest common seam for their size first, while the union is a disk that
/// lies flat with little stretch and is not too long to pack. Charts of fewer than `min_faces` faces may stretch more.
/// Of two charts one must have an id from `first` on. Ids of face_charts keep gaps.
void merge_charts(TriMesh const& mesh, FaceAdjacency const& adjacency, std::size_t min_faces, std::uint32_t first,
                  std::vector<std::uint32_t>& face_charts);

}  // namespace vitrine
