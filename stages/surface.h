// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What an original looks like at a point of its surface: the one place that knows vertex colours, materials, textures
/// and normal maps. Baking and rendering both ask here.

#include "stages/data.h"
#include "stages/lanes.h"
#include "stages/occlusion.h"
#include "stages/ray_scene.h"

#include <memory>
#include <optional>

namespace vitrine {

struct SurfaceSample {
  /// Linear base colour: factor x texture x vertex colour; coverage in the fourth. Thumbnails emit no light: what the
  /// surface emits is added, as far as the measure's light would make up for it.
  Rgba colour{1, 1, 1, 1};
  V3f normal{0, 1, 0};  ///< unit shading normal: interpolated, then the source's own normal map as clients draw it
};

/// The same for samples of one face side by side.
struct SurfaceLanes {
  LaneVector<4> colour;
  LaneVector<3> normal;
  LaneVector<3> emission;  ///< linear; only where any material emits
  Lanes occlusion;         ///< by the source's own occlusion map
};

/// One face, and what all its samples share. Of three values each the first is that of the first corner, the others are
/// the ways from there to the second and third corner.
struct Facet {
  std::uint32_t face = 0xffffffffu;
  Material const* material = nullptr;
  std::array<V3f, 3> corners{};  ///< places of all three
  V3f across{0, 0, 0};           ///< perpendicular, by the winding; as long as twice the area
  bool smooth = false;           ///< else the first normal is unit, and that of the whole face
  bool mapped = false;           ///< by any texture
  std::array<V3f, 3> normals{V3f(0), V3f(0), V3f(0)};
  std::array<Rgba, 3> colours{};                        ///< material's factor x vertex colour
  CornerUvs colour_uvs, normal_uvs;                     ///< of these maps, where there are any; places of all three
  std::array<V4f, 3> tangents{V4f(0), V4f(0), V4f(0)};  ///< where there is a normal map
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
  /// As clients draw it: textures are read from the level in which the longer of the two steps to a neighbouring pixel
  /// is a texel (OpenGL's trilinear filter). Steps count only on mapped facets.
  void sample(Facet const& facet, Places const& at, SurfaceLanes& samples) const;

  bool coloured() const;        ///< colour varies over the surface: vertex colours, a texture or several materials
  Rgba uniform_colour() const;  ///< the one colour, when it does not; white for models without colour
  AlphaMode alpha() const;      ///< blend if any material in use blends, mask if any cuts out
  /// The same of its thumbnail, which is of one material: blend only where most of the area blends. Clients draw the faces
  /// of what blends in the file's order and one through the other, so that a house would lose its walls to its windows.
  AlphaMode common_alpha() const;
  bool mapped() const;        ///< any texture covers it
  bool unlit() const;         ///< all materials in use are
  bool emissive() const;      ///< any material in use emits light
  bool double_sided() const;  ///< any material in use is

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The original as every trial needs it: made once per model. Holds the model, so that nothing dangles.
struct SurveyedModel {
  std::shared_ptr<SourceModel const> model;  ///< cleaned
  RayScene scene;
  Surface surface;
  std::optional<OcclusionField> occlusion = std::nullopt;  ///< where the survey traced it
};

/// `occlusion_rays`: more than 0 to trace the ambient occlusion of a model without colour, see OcclusionField.
SurveyedModel survey(std::shared_ptr<SourceModel const> model, int occlusion_rays = 0);

}  // namespace vitrine
