// SPDX-License-Identifier: Apache-2.0
#include "stages/judge.h"

#include "stages/area_average.h"

#include <cmath>

namespace vitrine {
namespace {

constexpr int kViews = 3, kSupersample = 2;

/// Means of byte values, as pictures drawn with more samples would have them.
std::vector<Image> reduced(std::vector<Image> pictures, int size) {
  for (Image& picture : pictures) {
    picture.space = ColourSpace::linear;
    picture = area_average(picture, size, size);
    picture.space = ColourSpace::srgb;
  }
  return pictures;
}

}  // namespace

std::vector<Judge> judges(SurveyedModel const& original, int viewport, double pixel_ratio, Occlusion occlusion) {
  int const size = int(std::lround(viewport * pixel_ratio));
  std::vector<Judge> all;
  for (auto const& [views, light] :
       {std::pair(ViewSet::turntable, Light::head), std::pair(ViewSet::sphere, Light::side)}) {
    Judge judge{reference(original, {views, kViews, size, light, kSupersample, occlusion}), {}};
    if (size > viewport) judge.coarse = reduced(judge.reference.pictures, viewport);
    all.push_back(std::move(judge));
  }
  return all;
}

Judgement judgement(std::vector<Judge> const& judges, SurveyedModel const& thumbnail, bool structure) {
  Judgement all;
  double sharp = 0, coarse = 0;
  auto const cost = [&](Difference const& mean) { return mean.mse1e4 * (structure ? 1 - mean.foreground_ssim : 1); };
  for (auto const& [reference, small] : judges) {
    std::vector<Image> drawn = pictures(thumbnail, reference);
    Difference const mean = compare(reference.pictures, drawn).mean;
    all.mse1e4 += mean.mse1e4 / double(judges.size());
    sharp += cost(mean);
    coarse += cost(small.empty() ? mean : compare(small, reduced(std::move(drawn), small[0].width)).mean);
  }
  all.score = std::sqrt(sharp * coarse);
  return all;
}

}  // namespace vitrine
