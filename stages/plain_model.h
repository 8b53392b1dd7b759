// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A thumbnail before anything is put on it.

#include "stages/surface.h"

namespace vitrine {

/// Mesh and place, the original's one colour, if it has one, its transparency then, unlit if the original is;
/// double-sided if the original is, or the mesh has a boundary.
BakedModel plain_model(TriMesh mesh, Grid const& grid, SurveyedModel const& original);

}  // namespace vitrine
