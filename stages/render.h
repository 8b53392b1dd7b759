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
  int size = 200;  ///< pixels of the square's side
  Light light = Light::head;
  bool grey = false;    ///< linear 0.5 in place of the base colour: how an object without any colour is drawn
  int supersample = 4;  ///< drawn so many times larger, then reduced; at most 4
  /// By the ambient occlusion that the survey traced, else by the model's own: its occlusion map; or, as colour, its
  /// base colour, which then counts as the share of that grey.
  Occlusion occlusion = Occlusion::none;
};

/// One picture for each camera: RGBA, on white, sRGB; alpha is the share of the pixel's samples that the object covers.
/// One sample in the middle of each cell, rounded to bytes, then averaged over the byte values: so the paper reduced
/// 800 x 800 screenshots to 200 x 200. Both sides of a surface are drawn; what cuts out lets the sight pass, what
/// blends is laid over what lies behind it.
/// In:     `model` need not be clean (a thumbnail is drawn as it is): without normals it is drawn flat.
/// Cost:   all views in parallel; the same bytes at any thread count. Opaque models go through a depth buffer, the
///         others through rays.
std::vector<Image> render(SurveyedModel const& model, std::vector<Camera> const& cameras,
                          PictureOptions const& options);

}  // namespace vitrine
