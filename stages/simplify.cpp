// SPDX-License-Identifier: Apache-2.0
#include "stages/simplify.h"

#include "stages/collapser.h"
#include "stages/simplify_openmesh.h"

namespace vitrine {

namespace {

template <class Q>
SimplifiedMesh collapse(TriMesh const& mesh, SimplifyOptions const& options, VertexColours const& colours) {
  std::size_t const target = std::size_t(options.triangles);
  Collapser<Q> collapser(mesh, options.max_error, colours);
  collapser.reduce_to(target);
  return {collapser.mesh().extract(), collapser.error(), collapser.stop(target)};
}

}  // namespace

SimplifiedMesh simplify(TriMesh const& mesh, SimplifyOptions const& options, VertexColours const& colours) {
  if (mesh.triangles.size() <= std::size_t(options.triangles))
    return {CollapseMesh(mesh).extract(), 0, StopReason::target_reached};
  if (options.decimator == Decimator::openmesh) return simplify_openmesh(mesh, options);
  return colours.weight > 0 ? collapse<ColourQuadric>(mesh, options, colours) : collapse<Quadric>(mesh, options, {});
}

}  // namespace vitrine
