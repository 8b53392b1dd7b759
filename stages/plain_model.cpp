// SPDX-License-Identifier: Apache-2.0
#include "stages/plain_model.h"

#include <algorithm>
#include <utility>

namespace vitrine {
namespace {

bool has_boundary(TriMesh const& mesh) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (Triangle const& face : mesh.triangles)
    for (int k = 0; k < 3; ++k) edges.push_back(std::minmax({face[k], face[(k + 1) % 3]}));
  std::sort(edges.begin(), edges.end());
  for (auto edge = edges.begin(); edge != edges.end();) {
    auto const next = std::find_if(edge, edges.end(), [&](auto const& other) { return other != *edge; });
    if (next - edge == 1) return true;
    edge = next;
  }
  return false;
}

}  // namespace

BakedModel plain_model(TriMesh mesh, Grid const& grid, SurveyedModel const& original) {
  BakedModel model;
  model.mesh = std::move(mesh);
  model.grid = grid;
  model.origin = original.model->origin;
  model.base_colour = original.surface.uniform_colour();
  model.alpha = model.base_colour[3] < 1 ? original.surface.common_alpha() : AlphaMode::opaque;
  model.unlit = original.surface.unlit();
  model.double_sided = original.surface.double_sided() || has_boundary(model.mesh);
  return model;
}

}  // namespace vitrine
