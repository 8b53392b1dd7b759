// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Creases: where an original's own normals break, as along the rim of a cylinder, and light breaks with them.

#include "stages/surface_samples.h"

#include <cstdint>
#include <vector>

namespace vitrine {

/// Whether the model's normals differ by more than 30 degrees at places that more than a few vertices share.
bool has_creases(SourceModel const& model);

struct PartedMesh {
  TriMesh mesh;                      ///< the same faces; vertices once for each side of a crease
  std::vector<std::uint32_t> whole;  ///< per vertex: the one that it was
};

/// Parts a light mesh's vertices between faces whose corners show the original's light from directions more than 30
/// degrees apart. What a corner shows is fitted to the samples of its face alone; faces without any part nothing.
/// Cost:   that of a VertexFit.
PartedMesh part_at_creases(TriMesh const& mesh, SurfaceSamples const& samples);

}  // namespace vitrine
