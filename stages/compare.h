// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How far two series of pictures are apart.

#include "stages/data.h"

#include <vector>

namespace vitrine {

/// Two pictures, or the mean of many. Foreground: the pixels that either object covers in part.
struct Difference {
  double mse1e4 = 0;             ///< mean square error of R, G, B as sRGB values in [0, 1], over all pixels, times 10^4
  double foreground_mse1e4 = 0;  ///< the same over the foreground; 0 if there is none
  double psnr = 0;               ///< dB, at most 100
  double ssim = 0;               ///< of the luminance
  double foreground_ssim = 0;    ///< windows centred in the foreground; 1 if there are none
  double iou = 0;                ///< sum of the smaller over sum of the larger coverage; 1 if both are empty
};

struct Comparison {
  std::vector<Difference> views;
  Difference mean;
  double psnr_of_mean_mse = 0;
  std::size_t worst = 0;  ///< the view with the largest mse1e4
};

/// In:     two pictures as `render` makes them: RGBA, the object drawn on white, alpha its coverage; square, of one
/// size,
///         at least 11 texels wide.
/// Source: Wang et al. 2004, "Image quality assessment: from error visibility to structural similarity": Gaussian
/// window
///         of 11 texels, sigma 1.5, whole windows only, on 0.299 R + 0.587 G + 0.114 B.
/// Errors: InvalidInput if the pictures differ in shape or are too small.
Difference compare(Image const& a, Image const& b);

/// View by view, in parallel; the means are taken in order. Errors: InvalidInput if the counts differ or are 0.
Comparison compare(std::vector<Image> const& a, std::vector<Image> const& b);

}  // namespace vitrine
