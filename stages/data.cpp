// SPDX-License-Identifier: Apache-2.0
#include "stages/data.h"

namespace vitrine {

Box3f bounds(TriMesh const& mesh) {
  Box3f box;
  for (V3f const& p : mesh.positions) box.extendBy(p);
  return box;
}

bool has_colour(SourceModel const& model) {
  if (!model.colours.empty()) return true;
  if (model.face_materials.empty()) return model.materials[0].coloured;
  for (std::uint16_t m : model.face_materials)
    if (model.materials[m].coloured) return true;
  return false;
}

}  // namespace vitrine
