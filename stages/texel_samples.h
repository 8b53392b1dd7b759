// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Which places of the mesh each texel of an atlas stands for.

#include "stages/closest_point.h"
#include "stages/data.h"

namespace vitrine {

/// Place on a face of the mesh.
struct SurfacePoint {
  std::uint32_t face = 0;
  Barycentric at;
};

/// A rectangle of the texture. A texel counts as reached when a chart comes so close to its centre (below the square
/// root of 2) that a client's bilinear lookup inside the chart can read it; all others show nothing.
struct TexelTile {
  int x = 0, y = 0, width = 0, height = 0;

  /// Row by row, one more than texels: texel t has samples[first[t]] ... samples[first[t + 1] - 1].
  /// Where charts cover some of its sub-grid, those; else, if it is reached, its `centre` alone.
  std::vector<std::uint32_t> first;
  std::vector<SurfacePoint> samples;
  std::vector<SurfacePoint> centres;  ///< where its centre lies, or the closest place to it; by texel, if reached
  std::uint32_t covered = 0;          ///< texels with a sample inside a chart
};

/// Cuts an atlas into tiles that can be sampled at once. The atlas must outlive it.
/// Where charts meet a sample belongs to the lowest face that covers it, a centre to the lowest of the closest, which
/// is the chart that reads it when charts are two texels apart.
class AtlasRaster {
 public:
  /// `side`: samples per texel form a regular grid of side x side.
  AtlasRaster(Atlas const& atlas, int side);

  std::size_t tiles() const { return tile_faces_.size(); }
  TexelTile sample(std::size_t tile) const;

 private:
  Atlas const& atlas_;
  int side_, columns_;
  std::vector<std::vector<std::uint32_t>> tile_faces_;  ///< that reach a texel of the tile, ascending
};

}  // namespace vitrine
