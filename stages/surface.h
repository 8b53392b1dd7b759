// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What an original looks like at a point of its surface: the one place that knows vertex colours, materials, textures
/// and normal maps. Baking and rendering both ask here.

#include "stages/closest_point.h"
#include "stages/data.h"
#include "stages/ray_scene.h"

#include <memory>

namespace vitrine {

struct SurfaceSample {
  Rgba colour{1, 1, 1, 1};  ///< linear base colour: factor x texture x vertex colour; coverage in the fourth
  V3f normal{0, 1, 0};      ///< unit shading normal: interpolated, then the source's own normal map as clients draw it
};

/// One face, and what all its samples share. Of three values each the first is that of the first corner, the others are
/// the ways from there to the second and third corner.
struct Facet {
  std::uint32_t face = 0xffffffffu;
  Material const* material = nullptr;
  std::array<V3f, 3> corners;     ///< places of all three
  V3f across{0, 0, 0};            ///< unit, by the winding
  bool smooth = false;            ///< else `across` is the normal everywhere
  bool mapped = false;            ///< by any texture
  std::array<V3f, 3> normals;     ///< if smooth
  std::array<Rgba, 3> colours;    ///< material's factor x vertex colour
  CornerUvs colour_uvs;           ///< of the colour map, if there is one; places of all three
};

/// Keeps filtered (mip-mapped) textures of one original. Immutable; calls may come from any thread. The model must
/// outlive it. Coverage is 1 for opaque materials, 0 or 1 for those that cut out, alpha for those that blend.
class Surface {
 public:
  explicit Surface(SourceModel const& model);
  ~Surface();
  Surface(Surface&&) noexcept;
  Surface& operator=(Surface&&) noexcept;

  /// `footprint`: diameter of the area that the sample stands for, in model units; 0 reads the finest level.
  SurfaceSample sample(Hit const& hit, float footprint) const;

  Facet facet(std::uint32_t face) const;
  /// As clients draw it: `steps` is how far the place moves on its face from a pixel to its neighbours, across and up;
  /// textures are read from the level in which the longer step is a texel (OpenGL's trilinear filter).
  SurfaceSample sample(Facet const& facet, Barycentric const& at, std::array<Barycentric, 2> const& steps) const;

  bool coloured() const;        ///< colour varies over the surface: vertex colours, a texture or several materials
  Rgba uniform_colour() const;  ///< the one colour, when it does not; white for models without colour
  AlphaMode alpha() const;      ///< blend if any material in use blends, mask if any cuts out
  bool unlit() const;           ///< all materials in use are
  bool double_sided() const;    ///< any material in use is

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The original as every trial needs it: made once per model. Holds the model, so that nothing dangles.
struct SurveyedModel {
  std::shared_ptr<SourceModel const> model;  ///< cleaned
  RayScene scene;
  Surface surface;
};

SurveyedModel survey(std::shared_ptr<SourceModel const> model);

}  // namespace vitrine
