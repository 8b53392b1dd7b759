// SPDX-License-Identifier: Apache-2.0
#include "stages/data.h"

namespace vitrine {

Box3f bounds(TriMesh const& mesh) {
  Box3f box;
  for (V3f const& p : mesh.positions) box.extendBy(p);
  return box;
}

Image opaque(Image const& picture) {
  Image rgb{picture.width, picture.height, 3, picture.space, {}};
  rgb.texels.reserve(picture.texels.size() / 4 * 3);
  for (std::size_t i = 0; i < picture.texels.size(); i += 4)
    rgb.texels.insert(rgb.texels.end(), &picture.texels[i], &picture.texels[i] + 3);
  return rgb;
}

bool has_colour(SourceModel const& model) {
  if (!model.colours.empty()) return true;
  if (model.face_materials.empty()) return model.materials[0].coloured;
  for (std::uint16_t m : model.face_materials)
    if (model.materials[m].coloured) return true;
  return false;
}

}  // namespace vitrine
