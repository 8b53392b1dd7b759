// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Colours per vertex in two numbers instead of three: places in a small picture of the colours that occur.
///
/// Draco packs the three channels of a colour each for itself, though they mostly rise and fall together, and on even
/// steps of linear light. A palette's u runs along the direction in which the colours differ most, v across, both on
/// steps even in sRGB. At the same error that takes half the bytes or less (10,800 triangles, error in sRGB of 0.012 to
/// 0.018: lion 3.6 against 6.5 KB, gargoyle 2.7 against 6.0, a textured photogrammetry model 3.7 against 6.4), less
/// some 370 for the picture and its mention.

#include "stages/data.h"

#include <span>
#include <vector>

namespace vitrine {

struct Palette {
  Image image;     ///< sRGB, RGB; read bilinearly, without smaller versions
  double off = 0;  ///< root of the mean square, per channel, of what the plane does not hold
  std::vector<V2f>
      uvs;  ///< one per colour, on the grid of `bits` over the unit square; half a texel or more off its edge
};

/// In:     colours, sRGB in [0,1], at least one; 3 to 8 bits.
/// Out:    the plane through the colours' mean along their two main directions, and for each colour the place whose
///         colour, as clients interpolate it in linear light, is nearest. Across the plane nothing is kept.
/// Source: Hotelling 1933, principal components.
/// Cost:   about a microsecond a colour.
Palette make_palette(std::span<V3f const> colours, int bits);

}  // namespace vitrine
