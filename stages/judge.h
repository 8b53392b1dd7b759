// SPDX-License-Identifier: Apache-2.0
#pragma once
/// By what the search tells which of two thumbnails is the better one.

#include "stages/measure.h"

#include <vector>

namespace vitrine {

/// One setting in which both are looked at.
struct Judge {
  Reference reference;  ///< at the pixels of a sharp screen
  std::vector<Image>
      coarse;  ///< its pictures, as a screen of one pixel per CSS pixel shows them; none where that is the same
};

/// All sides, both lights: three views of the turntable under the head light, three from all around under the side
/// light. `viewport`: CSS pixels; `pixel_ratio`: of the sharp screen.
/// Errors: those of reference().
std::vector<Judge> judges(SurveyedModel const& original, int viewport, double pixel_ratio, Occlusion occlusion);

struct Judgement {
  double mse1e4 = 0;  ///< mean over the judges, on the sharp screen
  /// Of each screen the sum of MSE x 10^4 x (1 - SSIM over the object), the geometric mean of both screens: visible
  /// facets, blocks and seams cost, too, and neither screen is served at the other's expense.
  double score = 0;
};

/// `structure`: otherwise the score is that of the mean square errors alone.
Judgement judgement(std::vector<Judge> const& judges, SurveyedModel const& thumbnail, bool structure = true);

}  // namespace vitrine
