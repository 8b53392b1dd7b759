// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What every model goes through first: repair what can be repaired, count it, refuse what is no surface.

#include "stages/data.h"

namespace vitrine {

struct Repairs {
  std::uint64_t nonfinite_vertices = 0;  ///< position NaN, infinite or beyond 1e18; the faces that use them are dropped
  std::uint64_t degenerate_faces = 0;    ///< without area: repeated or collinear corners
  std::uint64_t duplicate_faces = 0;     ///< the same three places again, in either winding
  std::uint64_t repaired_normals = 0;    ///< zero or non-finite normals replaced by the surface's
  std::uint64_t flipped_faces = 0;       ///< the whole model was wound against its own normals and is turned round
};

struct CleanModel {
  SourceModel
      model;  ///< valid: check(model) is empty; has normals (the file's, or area-weighted smooth ones of welded places)
  Repairs repairs;
  bool computed_normals = false;
};

/// Drops faces that have no area or no place, repairs normals, removes unused vertices.
/// A file whose normals point against its winding (more area against than with) is turned round.
/// Attributes that are not finite (colours, uvs) were dealt with by the reader.
/// Errors: InvalidInput when no face is left.
/// Cost:   O(n log n) worst, two copies of the attributes at most.
CleanModel clean(SourceModel model);

/// One vertex per place: vertices at equal positions become one, faces that collapse are dropped.
/// The order of vertices follows the first use in the source; the result may be non-manifold.
TriMesh weld(SourceModel const& model);

/// For each vertex the first one at the same place.
std::vector<std::uint32_t> shared_places(TriMesh const& mesh);

/// The same, but itself where vertices are shared anyhow: where they are no more than faces.
std::vector<std::uint32_t> merged_places(TriMesh const& mesh);

/// Area-weighted smooth normals, one per vertex (a vertex without area gets +Y). Vertices at equal places count as one.
std::vector<V3f> smooth_normals(TriMesh const& mesh);
/// The same where it is known which vertices count as one.
std::vector<V3f> smooth_normals(TriMesh const& mesh, std::vector<std::uint32_t> const& places);

}  // namespace vitrine
