// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Where on the original the samples of an atlas find their values: the search along the normal that bake() describes.
/// Internal to bake.

#include "stages/bake.h"
#include "stages/texel_samples.h"

#include <span>
#include <vector>

namespace vitrine {

/// Place on the original that a sample stands for.
struct TexelMatch {
  Hit hit;
  V3f side;             ///< outwards, as the sample looks for it
  bool missed = false;  ///< nothing lay along the normal
};

class TexelMatcher {
 public:
  /// `normals`: per vertex of the atlas's mesh; `per_side`: a texel has its square of samples. All must outlive this.
  TexelMatcher(Atlas const& atlas, std::vector<V3f> const& normals, SurveyedModel const& original,
               BakeOptions const& options, int per_side);

  /// One for each sample, in order. Any thread.
  std::vector<TexelMatch> matches(std::vector<SurfacePoint> const& samples) const;

  V3f smooth_normal(SurfacePoint const& point) const;
  float spacing(std::uint32_t face) const { return faces_[face].spacing; }  ///< of two samples, in model units

 private:
  struct Face {
    V3f normal;
    float spacing;
  };

  Face measured(std::uint32_t face, int per_side) const;
  V3f position(SurfacePoint const& point) const;
  V3f outwards(SurfacePoint const& point) const;
  Hit nearest(V3f const& place) const;
  void shoot(std::span<SurfacePoint const> packet, std::vector<TexelMatch>& found) const;

  Atlas const& atlas_;
  TriMesh const& mesh_;
  std::vector<V3f> const& normals_;
  RayScene const& scene_;
  Transfer transfer_;
  float reach_;
  std::vector<Face> faces_;
};

}  // namespace vitrine
