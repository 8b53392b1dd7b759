// SPDX-License-Identifier: Apache-2.0
#include "stages/surface.h"

#include "stages/closest_point.h"
#include "stages/looks.h"
#include "stages/mip_map.h"
#include "stages/tangent_frame.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vitrine {
namespace {

V2f transform(TextureUse const& use, V2f uv) {
  auto const& m = use.matrix;
  return {m[0] * uv.x + m[1] * uv.y + m[2], m[3] * uv.x + m[4] * uv.y + m[5]};
}

/// Filtered images, made where a material in use asks for them.
using MipMaps = std::vector<std::unique_ptr<MipMap const>>;

}  // namespace

struct Surface::Impl {
  SourceModel const& model;
  Looks looks;
  MipMaps colour_maps, normal_maps, emission_maps, occlusion_maps;

  explicit Impl(SourceModel const& of)
      : model(of),
        looks(of),
        colour_maps(of.images.size()),
        normal_maps(of.images.size()),
        emission_maps(of.images.size()),
        occlusion_maps(of.images.size()) {
    if (model.uvs.empty()) return;
    for (std::uint16_t m : looks.in_use) {
      add(model.materials[m].colour_map, ColourSpace::srgb, colour_maps);
      add(model.materials[m].normal_map, ColourSpace::linear, normal_maps);
      if (emits(model.materials[m])) add(model.materials[m].emission_map, ColourSpace::srgb, emission_maps);
      add(model.materials[m].occlusion_map, ColourSpace::linear, occlusion_maps);
    }
  }

  void add(TextureUse const& use, ColourSpace space, MipMaps& maps) const {
    if (use.image >= 0 && !maps[use.image])
      maps[use.image] = std::make_unique<MipMap const>(model.images[use.image], space);
  }

  Material const& material_of(std::uint32_t face) const {
    return model.materials[model.face_materials.empty() ? 0 : model.face_materials[face]];
  }

  template <class Value>
  std::array<Value, 3> corners(std::vector<Value> const& values, std::uint32_t face) const {
    Triangle const& t = model.mesh.triangles[face];
    return {values[t[0]], values[t[1]], values[t[2]]};
  }

  CornerUvs corner_uvs(TextureUse const& use, std::uint32_t face) const {
    CornerUvs uvs = corners(model.uvs, face);
    for (V2f& uv : uvs) uv = transform(use, uv);
    return uvs;
  }

  Facet facet(std::uint32_t face) const {
    Facet made;
    made.face = face;
    made.material = &material_of(face);
    made.corners = corners(model.mesh.positions, face);
    made.across = (made.corners[1] - made.corners[0]).cross(made.corners[2] - made.corners[0]);
    made.smooth = !model.normals.empty();
    if (made.smooth)
      made.normals = from_first(corners(model.normals, face));
    else
      made.normals[0] = made.across.normalized();
    made.colours = {made.material->base_colour, Rgba{}, Rgba{}};
    if (!model.colours.empty()) made.colours = vertex_colours(face, made.material->base_colour);
    if (!model.uvs.empty()) add_maps(made);
    return made;
  }

  void add_maps(Facet& facet) const {
    TextureUse const &colour = facet.material->colour_map, &normal = facet.material->normal_map;
    facet.mapped = colour.image >= 0 || normal.image >= 0 || facet.material->emission_map.image >= 0 ||
                   facet.material->occlusion_map.image >= 0;
    if (colour.image >= 0) facet.colour_uvs = corner_uvs(colour, facet.face);
    if (normal.image >= 0) facet.normal_uvs = corner_uvs(normal, facet.face);
    if (normal.image >= 0 && !model.tangents.empty()) facet.tangents = from_first(corners(model.tangents, facet.face));
  }

  template <class Vector>
  static std::array<Vector, 3> from_first(std::array<Vector, 3> const& at) {
    return {at[0], at[1] - at[0], at[2] - at[0]};
  }

  std::array<Rgba, 3> vertex_colours(std::uint32_t face, Rgba const& factor) const {
    auto const bytes = corners(model.colours, face);
    std::array<Rgba, 3> colours;
    for (int k = 0; k < 4; ++k) {
      float const scale = factor[k] * (1 / 65535.f);
      for (int c = 0; c < 3; ++c) colours[c][k] = float(bytes[c][k] - (c > 0 ? bytes[0][k] : 0)) * scale;
    }
    return colours;
  }

  static void vertex_normals(Facet const& facet, Places const& at, LaneVector<3>& normals) {
    interpolate(facet.normals, at, normals);
    if (!facet.smooth || make_unit(normals, at.count)) return;
    for (std::size_t i = 0; i < at.count; ++i)
      if (lane(normals, i) == V3f(0)) set_lane(normals, i, facet.across.normalized());
  }

  /// `texels(use, uvs)`: how many texels of the image each sample's footprint is across, squared.
  template <class Texels>
  void sample(Facet const& facet, Places const& at, Texels const& texels, SurfaceLanes& samples) const {
    interpolate(facet.colours, at, samples.colour);
    vertex_normals(facet, at, samples.normal);
    Material const& material = *facet.material;
    if (facet.mapped && material.colour_map.image >= 0) {
      LaneVector<4> const read = look_up(material.colour_map, colour_maps, facet.colour_uvs, at, texels);
      for (std::size_t k = 0; k < 4; ++k)
        for (std::size_t i = 0; i < at.count; ++i) samples.colour[k][i] *= read[k][i];
    }
    if (facet.mapped && material.normal_map.image >= 0) tilt(facet, at, texels, samples.normal);
    if (looks.emissive) emit(facet, at, texels, samples.emission);
    samples.occlusion.fill(1);
    if (facet.mapped && material.occlusion_map.image >= 0) occlude(facet, at, texels, samples.occlusion);
    for (std::size_t i = 0; i < at.count; ++i) samples.colour[3][i] = coverage(material, samples.colour[3][i]);
  }

  template <class Texels>
  LaneVector<4> look_up(TextureUse const& use, MipMaps const& maps, CornerUvs const& uvs, Places const& at,
                        Texels const& texels) const {
    Lanes const squared = texels(use, uvs);
    LaneVector<4> read;
    for (std::size_t i = 0; i < at.count; ++i) {
      float const level = squared[i] > 1 ? std::log2(squared[i]) / 2 : 0;
      V2f const uv = interpolate(uvs[0], uvs[1], uvs[2], {at.u[i], at.v[i]});
      Rgba const texel = maps[use.image]->sample(uv, level, use);
      for (std::size_t k = 0; k < 4; ++k) read[k][i] = texel[k];
    }
    return read;
  }

  template <class Texels>
  void emit(Facet const& facet, Places const& at, Texels const& texels, LaneVector<3>& emission) const {
    Material const& material = *facet.material;
    for (unsigned k = 0; k < 3; ++k) emission[k].fill(emits(material) ? material.emission[k] : 0);
    if (!emits(material) || !facet.mapped || material.emission_map.image < 0) return;
    CornerUvs const uvs = corner_uvs(material.emission_map, facet.face);
    LaneVector<4> const read = look_up(material.emission_map, emission_maps, uvs, at, texels);
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t i = 0; i < at.count; ++i) emission[k][i] *= read[k][i];
  }

  template <class Texels>
  void occlude(Facet const& facet, Places const& at, Texels const& texels, Lanes& occlusion) const {
    Material const& material = *facet.material;
    CornerUvs const uvs = corner_uvs(material.occlusion_map, facet.face);
    LaneVector<4> const read = look_up(material.occlusion_map, occlusion_maps, uvs, at, texels);
    for (std::size_t i = 0; i < at.count; ++i) occlusion[i] = 1 + material.occlusion_strength * (read[0][i] - 1);
  }

  /// By the normal map: in the frame that TANGENT gives where the file has it, else that of the surface's derivatives.
  template <class Texels>
  void tilt(Facet const& facet, Places const& at, Texels const& texels, LaneVector<3>& normals) const {
    Material const& material = *facet.material;
    LaneVector<4> const read = look_up(material.normal_map, normal_maps, facet.normal_uvs, at, texels);
    LaneVector<3> m;
    for (std::size_t i = 0; i < at.count; ++i) {
      m[0][i] = (read[0][i] * 2 - 1) * material.normal_scale;
      m[1][i] = (read[1][i] * 2 - 1) * material.normal_scale;
      m[2][i] = read[2][i] * 2 - 1;
    }
    LaneVector<4> tangents;
    interpolate(facet.tangents, at, tangents);
    LaneVector<3> const shown = in_stored_frames(tangents, normals, m, at.count);
    for (std::size_t i = 0; i < at.count; ++i) {
      bool const stored = tangents[0][i] != 0 || tangents[1][i] != 0 || tangents[2][i] != 0;
      V3f const normal = lane(normals, i);
      V3f const tilted = stored ? lane(shown, i)
                                : from_tangent_space(client_frame(facet.corners, facet.normal_uvs, normal), lane(m, i));
      if (tilted != V3f(0)) set_lane(normals, i, tilted);
    }
  }
};

Surface::Surface(SourceModel const& model) : impl_(std::make_unique<Impl>(model)) {}
Surface::~Surface() = default;
Surface::Surface(Surface&&) noexcept = default;
Surface& Surface::operator=(Surface&&) noexcept = default;

SurfaceSample Surface::sample(Hit const& hit, float footprint) const {
  Facet const facet = impl_->facet(hit.face);
  Places at;
  at.count = 1, at.u[0] = hit.u, at.v[0] = hit.v;
  SurfaceLanes made;
  auto const texels = [&](TextureUse const& use, CornerUvs const& uvs) {
    Image const& image = impl_->model.images[use.image];
    float const all = std::abs((uvs[1] - uvs[0]).cross(uvs[2] - uvs[0])) * float(image.width) * float(image.height);
    return Lanes{footprint * footprint * all / facet.across.length()};
  };
  impl_->sample(facet, at, texels, made);
  Rgba colour{made.colour[0][0], made.colour[1][0], made.colour[2][0], made.colour[3][0]};
  if (impl_->looks.emissive) colour = with_emission(colour, lane(made.emission, 0));
  return {colour, lane(made.normal, 0)};
}

Facet Surface::facet(std::uint32_t face) const { return impl_->facet(face); }

void Surface::sample(Facet const& facet, Places const& at, SurfaceLanes& samples) const {
  auto const texels = [&](TextureUse const& use, CornerUvs const& uvs) {
    if (!use.mipmapped) return Lanes{};
    Image const& image = impl_->model.images[use.image];
    V2f const size(float(image.width), float(image.height));
    V2f const along_b = (uvs[1] - uvs[0]) * size, along_c = (uvs[2] - uvs[0]) * size;
    Lanes squared;
    for (std::size_t i = 0; i < at.count; ++i) {
      std::array<float, 2> lengths;
      for (std::size_t s = 0; s < 2; ++s) {
        float const x = along_b.x * at.step_u[s][i] + along_c.x * at.step_v[s][i];
        float const y = along_b.y * at.step_u[s][i] + along_c.y * at.step_v[s][i];
        lengths[s] = x * x + y * y;
      }
      squared[i] = lengths[0] > lengths[1] ? lengths[0] : lengths[1];
    }
    return squared;
  };
  impl_->sample(facet, at, texels, samples);
}

bool Surface::coloured() const { return impl_->looks.coloured; }
Rgba Surface::uniform_colour() const { return impl_->looks.uniform_colour; }
AlphaMode Surface::alpha() const { return impl_->looks.alpha; }
AlphaMode Surface::common_alpha() const { return impl_->looks.common_alpha; }
bool Surface::mapped() const { return impl_->looks.mapped; }
bool Surface::unlit() const { return impl_->looks.unlit; }
bool Surface::emissive() const { return impl_->looks.emissive; }
bool Surface::double_sided() const { return impl_->looks.double_sided; }

SurveyedModel survey(std::shared_ptr<SourceModel const> model, int occlusion_rays) {
  SourceModel const& held = *model;
  SurveyedModel made{std::move(model), RayScene(held.mesh), Surface(held)};
  if (occlusion_rays > 0 && !has_colour(held))
    made.occlusion.emplace(held.mesh, made.scene, made.surface, occlusion_rays);
  return made;
}

}  // namespace vitrine
