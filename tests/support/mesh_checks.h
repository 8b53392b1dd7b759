// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What tests measure on meshes.

#include "stages/data.h"

namespace vitrine::test {

/// Normal times area.
V3d area_vector(TriMesh const& mesh, Triangle const& t);

/// Edges that are not passed as often in one direction as in the other.
std::size_t open_edges(TriMesh const& mesh);

/// Mean distance from seeded points on `from` to `to`, as a share of the bounding box's diagonal.
double mean_distance(TriMesh const& from, TriMesh const& to);

/// Mean angle, in radians, between the faces of `from` and the closest ones of `to`, by area.
double mean_angle(TriMesh const& from, TriMesh const& to);

}  // namespace vitrine::test
