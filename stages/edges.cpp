// SPDX-License-Identifier: Apache-2.0
#include "stages/edges.h"

namespace vitrine {

Outline outline(TriMesh const& mesh) {
  Outline found;
  for_edges(mesh, [&](std::span<FaceEdge const> edge) {
    if (edge.size() == 1) found.open.push_back(edge[0]);
    if (edge.size() > 2) found.tangled.insert(found.tangled.end(), edge.begin(), edge.end());
  });
  return found;
}

}  // namespace vitrine
