// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How good a thumbnail is: its pictures against those of its original, from the same cameras. Section 4 of the paper.

#include "stages/compare.h"
#include "stages/render.h"

namespace vitrine {

struct MeasureOptions {
  ViewSet views = ViewSet::turntable;
  int count = 32;
  int size = 200;
  Light light = Light::head;
  int supersample = 4;
  Occlusion occlusion = Occlusion::none;  ///< of originals without colour; the thumbnail's is its own

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(self.views, Field{"views", "", "from where both are looked at"});
    visit(self.count, Field{"count", "views", "how many", 1, 1024});
    visit(self.size, Field{"size", "pixels", "side of a picture", 11, 1024});
    visit(self.light, Field{"light", "", "from the camera, or from its upper left"});
    visit(self.supersample, Field{"supersample", "", "pictures are drawn so many times larger, then reduced", 1, 4});
    visit(self.occlusion,
          Field{"ao", "",
                "draw originals without colour with ambient occlusion: of the ambient light, as glTF's, or "
                "as grey colour; and thumbnails with theirs"});
  }
};

/// What survey must be told, so that the original can be drawn by these options.
int occlusion_rays(MeasureOptions const& options);

/// The original's side of every comparison: made once per original.
struct Reference {
  MeasureOptions options;
  BoundingSphere sphere;
  std::vector<Camera> cameras;
  std::vector<Image> pictures;
  bool coloured = false;  ///< has_colour; an original without any is drawn grey
};

/// The cameras alone, nothing drawn. Errors: those of bounding_sphere.
Reference viewpoints(SurveyedModel const& original, MeasureOptions const& options);
/// In:     an original whose occlusion is traced, if options.occlusion asks for it and it has no colour.
/// Errors: those of bounding_sphere.
Reference reference(SurveyedModel const& original, MeasureOptions const& options);

/// The original from other cameras, drawn as the reference's own pictures are.
std::vector<Image> draw_original(SurveyedModel const& original, std::vector<Camera> const& cameras,
                                 Reference const& like);

/// The thumbnail as the original's cameras see it. Where neither side has a colour both are drawn in one grey; a
/// thumbnail with a colour texture or vertex colours is drawn as it is, unless that is the occlusion of an original
/// without colour: then white stands for the same grey on both sides.
std::vector<Image> pictures(SurveyedModel const& thumbnail, Reference const& original);

/// Share of the pictures' area that the object covers.
double coverage(std::vector<Image> const& pictures);

}  // namespace vitrine
