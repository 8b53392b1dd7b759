// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Flattens one chart; parameterize runs it over all of them, segment asks it whether two charts may become one.

#include "stages/data.h"

namespace vitrine {

/// A disk laid flat. Area equal to that in space; seen with v down, as images are, front faces are counter-clockwise.
struct FlatDisk {
  std::vector<V2f> uvs;      ///< n, of the disk's vertices
  double length = 0;         ///< larger side of the box around the uvs, which lies along the pins
  double stretch = 1;        ///< L2 stretch of Sander et al. 2001 (1: isometric)
  double area_spread = 1;    ///< largest scale of areas to smallest, save 2 % of the area at either end
  bool folded = false;       ///< a face lies on its back
  bool overlapping = false;  ///< the boundary crosses itself
};

struct FlatLimits {
  double stretch, area_spread;
};

inline constexpr FlatLimits kEasyToUnfold{1.3, 8};  ///< charts are merged while their union keeps these
inline constexpr FlatLimits kBearable{1.8, 16};     ///< beyond, texels starve

/// Neither folded nor overlapping, and within the limits.
bool lies_flat(FlatDisk const& flat, FlatLimits const& limits);

/// Least-squares conformal map of a disk. Source: Levy et al. 2002, section 3; pins: the two farthest boundary
/// vertices. Faces without area take part as slivers of a millionth of their length. Never NaN.
FlatDisk flatten(TriMesh const& disk);

/// What is to be said of any map of a disk that is no dot.
FlatDisk judged(TriMesh const& disk, std::vector<V2f> uvs);

}  // namespace vitrine
