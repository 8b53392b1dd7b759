// SPDX-License-Identifier: Apache-2.0
#pragma once
/// An image and its smaller versions, for filtered lookup.
/// Source: Williams 1983, "Pyramidal Parametrics".

#include "stages/data.h"

namespace vitrine {

/// Levels halve the size (rounded down) until one texel is left; each is the one before it, read bilinearly at the
/// middles of the new texels, in linear light when the image is sRGB, and rounded to 8 bits: a box filter where sizes
/// are even, and where they are odd what the drivers of clients do. Levels of up to 512 x 512 texels are kept decoded,
/// in floats: they are what most pictures and all thumbnails read. The image must outlive the map; its `space` does not
/// count.
class MipMap {
 public:
  MipMap(Image const& image, ColourSpace space);

  /// Trilinear lookup, linear values in [0,1]; grey images give equal channels, those without alpha 1.
  /// `level`: 0 the image itself, 1 half its size, ...; clamped to what there is. `use`: how it is wrapped and filtered.
  Rgba sample(V2f uv, float level, TextureUse const& use) const;

 private:
  Image const& level_image(std::size_t level) const { return level == 0 ? base_ : smaller_[level - 1]; }
  Rgba sample_level(std::size_t level, V2f wrapped, TextureUse const& use, Filter filter) const;

  Image const& base_;
  ColourSpace space_;
  std::vector<Image> smaller_;
  std::vector<std::vector<Rgba>> decoded_;  ///< by level; empty where it is too large
};

}  // namespace vitrine
