// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Where an original shows more than elsewhere.

#include "stages/surface_samples.h"

#include <vector>

namespace vitrine {

/// For each face of a light mesh the length that its texels are worth: with the density of texels going with the
/// colours' slope, a map of any size has the least error. The mean over the area of its square is about 1; 0.5 to 2,
/// smooth.
/// In:     a welded mesh, and the original's samples.
/// Out:    all 1 for originals of one colour.
/// Source: after Sander et al. 2002, "Signal-Specialized Parametrization".
/// Cost:   half a microsecond a sample.
std::vector<float> detail_lengths(TriMesh const& mesh, SurfaceSamples const& samples);

}  // namespace vitrine
