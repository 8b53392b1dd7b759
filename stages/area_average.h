// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Images made smaller: each texel is the mean of the area below it.

#include "stages/data.h"

#include <cstddef>
#include <vector>

namespace vitrine {

/// A texel of a longer line lies by this share of its mean under a texel of the shorter line.
struct Overlap {
  std::size_t to, from;
  float share;
};

/// Of a line of `length` texels with one of `count`, in the order of the shorter line. Both at least 1.
std::vector<Overlap> overlaps(int length, int count);

/// In:     an image of 1 to 4 channels, its sides at least 1.
/// Out:    RGB, or RGBA where it has alpha, width x height (at most its own, at least 1). Means are taken in linear
///         light where the image is sRGB; alpha is a channel like the others, as in clients' own smaller versions.
Image area_average(Image const& image, int width, int height);

}  // namespace vitrine
