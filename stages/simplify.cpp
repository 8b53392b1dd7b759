// SPDX-License-Identifier: Apache-2.0
#include "stages/simplify.h"

#include "stages/collapser.h"
#include "stages/simplify_openmesh.h"

namespace vitrine {

SimplifiedMesh simplify(TriMesh const& mesh, SimplifyOptions const& options) {
  std::size_t const target = std::size_t(options.triangles);
  if (mesh.triangles.size() <= target) return {CollapseMesh(mesh).extract(), 0, StopReason::target_reached};
  if (options.decimator == Decimator::openmesh) return simplify_openmesh(mesh, options);
  Collapser collapser(mesh, options.max_error);
  collapser.reduce_to(target);
  return {collapser.mesh().extract(), collapser.error(), collapser.stop(target)};
}

}  // namespace vitrine
