// SPDX-License-Identifier: Apache-2.0
#include "stages/measure.h"

#include <algorithm>

namespace vitrine {
namespace {

bool painted(SourceModel const& model) {
  auto const textured = [](Material const& m) { return m.colour_map.image >= 0; };
  return !model.colours.empty() || std::any_of(model.materials.begin(), model.materials.end(), textured);
}

}  // namespace

int occlusion_rays(MeasureOptions const& options) { return options.occlusion == Occlusion::none ? 0 : kOcclusionRays; }

Reference viewpoints(SurveyedModel const& original, MeasureOptions const& options) {
  Reference made{options, bounding_sphere(*original.model), {}, {}, has_colour(*original.model)};
  if (made.coloured) made.options.occlusion = Occlusion::none;
  for (V3d const& direction : directions(options.views, options.count))
    made.cameras.push_back(camera(made.sphere, direction));
  return made;
}

Reference reference(SurveyedModel const& original, MeasureOptions const& options) {
  Reference made = viewpoints(original, options);
  made.pictures = draw_original(original, made.cameras, made);
  return made;
}

std::vector<Image> draw_original(SurveyedModel const& original, std::vector<Camera> const& cameras,
                                 Reference const& like) {
  MeasureOptions const& options = like.options;
  return render(original, cameras,
                {options.size, options.light, !like.coloured, options.supersample, options.occlusion});
}

std::vector<Image> pictures(SurveyedModel const& thumbnail, Reference const& original) {
  MeasureOptions const& options = original.options;
  bool const grey = !original.coloured && (options.occlusion == Occlusion::colour || !painted(*thumbnail.model));
  return render(thumbnail, original.cameras,
                {options.size, options.light, grey, options.supersample, options.occlusion});
}

double coverage(std::vector<Image> const& pictures) {
  double covered = 0, all = 0;
  for (Image const& picture : pictures)
    for (std::size_t i = 3; i < picture.texels.size(); i += 4) covered += picture.texels[i], all += 255;
  return all > 0 ? covered / all : 0;
}

}  // namespace vitrine
