// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Pictures of an original or a thumbnail, as a client shows them.

#include "stages/surface.h"
#include "stages/view.h"

#include <vector>

namespace vitrine {

enum class Light {
  head,  ///< from the camera
  side   ///< from the upper left before the object
};
template <>
struct EnumNames<Light> {
  static constexpr std::array<std::string_view, 2> names{"head", "side"};
};

struct PictureOptions {
  int size = 200;  ///< pixels of the square's side; drawn four times larger, then reduced
  Light light = Light::head;
  bool grey = false;  ///< linear 0.5 in place of the base colour: how an object without any colour is drawn
};

/// One picture for each camera: RGBA, on white, sRGB; alpha is the share of the pixel's 16 samples that the object
/// covers. One ray through the middle of each sample, rounded to bytes, then 4 x 4 averaged over the byte values: so
/// the paper reduced 800 x 800 screenshots to 200 x 200. Both sides of a surface are drawn; what cuts out lets the ray
/// pass, what blends is laid over what lies behind it. In:     `model` need not be clean (a thumbnail is drawn as it
/// is): without normals it is drawn flat. Cost:   one picture each in memory, all views in parallel; the same bytes at
/// any thread count.
std::vector<Image> render(SurveyedModel const& model, std::vector<Camera> const& cameras,
                          PictureOptions const& options);

}  // namespace vitrine
