// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How far a light mesh leaves its original.

#include "stages/surface_samples.h"

namespace vitrine {

/// The largest distance from the original's samples to the mesh: the one-sided Hausdorff distance, as far as samples
/// see it; infinite for a mesh without faces.
/// Source: Cignoni et al. 1998, "Metro: Measuring Error on Simplified Surfaces".
/// Cost:   about a microsecond a sample, in parallel.
double deviation(TriMesh const& light, SurfaceSamples const& samples);

/// Length that a pixel shows at the middle of an object of this bounding sphere, in a picture of `size` pixels.
double pixel_length(double sphere_radius, int size);

}  // namespace vitrine
