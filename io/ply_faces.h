// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Faces and triangle strips of a PLY file. Internal to io.

#include "io/assemble.h"
#include "io/ply_body.h"

#include <cstdint>
#include <vector>

namespace vitrine::io {

/// What to read of the faces besides their corners, where the file has it.
struct PlyFaceWants {
  std::uint64_t vertices = 0;  ///< every index must be below
  bool uvs = false, textures = false, colours = false;
};

/// Triangles, and their attributes: each list empty or one per triangle.
struct PlyFaces {
  std::vector<Triangle> triangles;
  CornerAttributes corners;
  std::vector<std::int64_t> textures;  ///< texnumber; negative: none
};

/// Reads element `face`: polygons become fans, texture coordinates point down as in glTF, missing ones are 0.
/// Errors: InvalidInput for an index out of range and for colours or coordinates that are not finite, with the face;
///         LimitExceeded; those of PlyBody.
void read_ply_faces(PlyBody& body, PlyElement const& element, PlyFaceWants const& wants, ReadLimits const& limits,
                    PlyFaces& faces);

/// Reads element `tristrips`: lists of indices; a negative one ends a strip and the next begins anew.
void read_ply_strips(PlyBody& body, PlyElement const& element, std::uint64_t vertices, PlyFaces& faces);

}  // namespace vitrine::io
