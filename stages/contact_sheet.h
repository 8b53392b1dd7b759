// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Pictures side by side, to see where a thumbnail is off.

#include "stages/data.h"

#include <vector>

namespace vitrine {

/// For each view the original, the thumbnail and the squared difference (of sRGB values in [0, 1], times 8), side by
/// side; eight views to a column, columns from left to right. In:  two series of n > 0 RGBA pictures of one size. Out:
/// RGB, sRGB; what is left over is white.
Image contact_sheet(std::vector<Image> const& originals, std::vector<Image> const& thumbnails);

}  // namespace vitrine
