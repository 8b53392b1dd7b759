// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The colours that simplification heeds.

#include "stages/surface.h"

#include <vector>

namespace vitrine {

/// One colour, sRGB in [0,1], per vertex of weld(*original.model): that of the first of its faces, read a little
/// inside, over an area as large as a third of the face.
/// Cost: about 0.2 microseconds a vertex, in parallel.
std::vector<V3f> welded_colours(SurveyedModel const& original, TriMesh const& welded);

/// The same for a coarser mesh that lies close to the original: of the closest point, read over an edge's length.
/// Cost: about two microseconds a vertex, in parallel.
std::vector<V3f> colours_near(SurveyedModel const& original, TriMesh const& mesh);

}  // namespace vitrine
