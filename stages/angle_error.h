// SPDX-License-Identifier: Apache-2.0
#pragma once
/// By how much a coded normal map turns its normals.

#include "stages/data.h"

namespace vitrine {

/// Degrees: of half the texels no more, and of 99 in 100.
struct AngleError {
  float p50 = 0, p99 = 0;
};

/// In:  two tangent space normal maps of one size, 3 channels.
/// Out: degrees between their normals, texel by texel: the median, and what 99 of 100 texels keep below.
AngleError angle_error(Image const& map, Image const& coded);

}  // namespace vitrine
