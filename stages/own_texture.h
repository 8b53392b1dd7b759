// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The original's own texture at the original's own coordinates: for models of few triangles, hard edges in their
/// texture, or a texture that repeats, of which an atlas of our own would be a blurred and larger copy.

#include "stages/paint.h"
#include "stages/surface.h"

#include <optional>

namespace vitrine {

/// A mesh under one texture.
struct TexturedMesh {
  TriMesh mesh;              ///< vertices split where their coordinates differ
  std::vector<V2f> uvs;      ///< one per vertex, as the image is read: material's transform applied
  std::size_t material = 0;  ///< of the original: image, wrapping and factor
};

/// Nothing where the original is not drawn so: colours per vertex, faces of different colour maps, factors or wrapping,
/// or coordinates that span more than 64 repetitions.
std::optional<TexturedMesh> own_texture(SourceModel const& model);

/// The image that the texture is read from.
Image const& own_image(SourceModel const& model, TexturedMesh const& textured);

/// Collapses onto existing vertices; seams collapse along themselves, so coordinates stay exact.
/// Out:    `triangles` faces, more where the seams hold more; welded, with corner_uvs.
/// Source: meshoptimizer's simplifier (Kapoulkine), after Garland & Heckbert 1997.
SimplifiedMesh simplify(TexturedMesh const& textured, int triangles);

struct OwnTextureOptions {
  int position_bits = 10;
  int texture = 256;     ///< texels of the image's longer side; never more than it has
  bool normals = false;  ///< fitted as paint() does
  bool creases = false;  ///< likewise
  int normal_bits = 6;
};

/// In:     a level of simplify(), possibly moved since, and where its texture came from.
/// Out:    the image reduced to the size asked for; texture coordinates on a grid of a quarter of a texel.
BakedModel wear_own_texture(SimplifiedMesh const& light, TexturedMesh const& textured, SurveyedModel const& original,
                            SurfaceSamples const& samples, OwnTextureOptions const& options);

}  // namespace vitrine
