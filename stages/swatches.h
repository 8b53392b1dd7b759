// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Flat colours: models made by hand often show a few, each face one of them, and their edges are sharp.

#include "stages/surface_samples.h"

#include <vector>

namespace vitrine {

/// The colours, 8-bit sRGB, that samples show to within three steps of each channel, the commonest first. What fewer
/// than eight samples show is left out, as filters mix it at the edges of a texture's patches. None where more than 64
/// are left, as on any scan, where more than one sample in 200 shows another, or one in ten is off by more than a step,
/// as in a ramp of greys.
std::vector<V3f> flat_colours(SurfaceSamples const& samples);

struct Swatches {
  Image image;  ///< sRGB, RGB: each colour twice in a row, so that what is read bilinearly between the two is exact
  std::vector<V2f> uvs;  ///< per face, on the grid of `uv_bits` over the unit square
  int uv_bits = 0;
};

/// Each face bears the one of samples.flat that most of its samples show, where there are none the one nearest to what
/// the original shows closest to its middle.
/// Cost:   0.2 microseconds a sample, in parallel.
Swatches make_swatches(TriMesh const& mesh, SurveyedModel const& original, SurfaceSamples const& samples);

}  // namespace vitrine
