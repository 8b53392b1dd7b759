// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Ambient occlusion: how much of an evenly bright sky the places of a surface see.

#include "stages/options.h"
#include "stages/ray_scene.h"

#include <cstdint>
#include <vector>

namespace vitrine {

class Surface;

/// What is made of it, for models without colour; both sides of a comparison alike.
enum class Occlusion {
  none,
  occlusion,  ///< darkens the ambient light alone, as glTF's occlusionTexture does
  colour      ///< is the base colour, in grey, as in the paper
};
template <>
struct EnumNames<Occlusion> {
  static constexpr std::array<std::string_view, 3> names{"none", "occlusion", "colour"};
};

/// Usual number of rays per cell: what is left of noise adds less than 0.1 x 10^-4 to the error of a picture in grey.
inline constexpr int kOcclusionRays = 64;

/// Light of the sky, weighted by the cosine to the normal, that reaches each place of a surface: 1 in the open.
///
/// Traced once per original, as fine as a picture of 256 pixels resolves: places that lie in one cell of a grid of that
/// pitch and look the same way share a value, the mean over all of them, so that the cost depends on neither the number
/// of triangles nor that of views, and a finer scan yields no more noise. Places are the vertices, and points inside
/// those faces that are longer than two cells; in between values are interpolated. As many rays for
/// each pixel of the 32 views would cost several times as much.
class OcclusionField {
 public:
  /// `rays` per cell: the same Hammersley points everywhere, turned at random. `surface` says the normals.
  /// Cost: rays times the cells that the surface touches (some 30,000 to 150,000); 28 bytes a vertex while it is made,
  /// 2 afterwards. The same values at any thread count.
  OcclusionField(TriMesh const& mesh, RayScene const& scene, Surface const& surface, int rays);

  float at(TriMesh const& mesh, Hit const& hit) const;

  /// A face that is cut into steps^2 equal ones: where its values begin, row by row.
  struct Cut {
    std::uint32_t face, first, steps;
  };

 private:
  float between(std::array<std::size_t, 3> const& places, float u, float v) const;

  std::vector<std::uint16_t> values_;  ///< of the vertices, then of cut faces; 65535 is 1
  std::vector<Cut> cuts_;              ///< by face
};

}  // namespace vitrine
