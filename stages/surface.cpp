// SPDX-License-Identifier: Apache-2.0
#include "stages/surface.h"

#include "stages/closest_point.h"
#include "stages/mip_map.h"
#include "stages/tangent_frame.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vitrine {
namespace {

Rgba multiply(Rgba a, Rgba const& b) {
  for (int k = 0; k < 4; ++k) a[k] *= b[k];
  return a;
}

Rgba to_float(Rgba16 const& colour) {
  Rgba scaled;
  for (int k = 0; k < 4; ++k) scaled[k] = float(colour[k]) / 65535;
  return scaled;
}

float coverage(Material const& material, float alpha) {
  if (material.alpha == AlphaMode::opaque) return 1;
  if (material.alpha == AlphaMode::mask) return alpha >= material.alpha_cutoff ? 1 : 0;
  return std::clamp(alpha, 0.f, 1.f);
}

V2f transform(TextureUse const& use, V2f uv) {
  auto const& m = use.matrix;
  return {m[0] * uv.x + m[1] * uv.y + m[2], m[3] * uv.x + m[4] * uv.y + m[5]};
}

std::vector<std::uint16_t> materials_in_use(SourceModel const& model) {
  if (model.face_materials.empty()) return {0};
  std::vector<bool> used(model.materials.size(), false);
  for (std::uint16_t m : model.face_materials) used[m] = true;
  std::vector<std::uint16_t> in_use;
  for (std::size_t m = 0; m < used.size(); ++m)
    if (used[m]) in_use.push_back(static_cast<std::uint16_t>(m));
  return in_use;
}

bool all_equal(std::vector<Rgba16> const& colours) {
  return std::all_of(colours.begin(), colours.end(), [&](Rgba16 const& c) { return c == colours[0]; });
}

/// Filtered images, made where a material in use asks for them.
using MipMaps = std::vector<std::unique_ptr<MipMap const>>;

}  // namespace

struct Surface::Impl {
  SourceModel const& model;
  std::vector<std::uint16_t> in_use;
  MipMaps colour_maps, normal_maps;

  explicit Impl(SourceModel const& of)
      : model(of), in_use(materials_in_use(of)), colour_maps(of.images.size()), normal_maps(of.images.size()) {
    if (model.uvs.empty()) return;
    for (std::uint16_t m : in_use) {
      add(model.materials[m].colour_map, ColourSpace::srgb, colour_maps);
      add(model.materials[m].normal_map, ColourSpace::linear, normal_maps);
    }
  }

  void add(TextureUse const& use, ColourSpace space, MipMaps& maps) const {
    if (use.image >= 0 && !maps[use.image])
      maps[use.image] = std::make_unique<MipMap const>(model.images[use.image], space);
  }

  Material const& material_of(std::uint32_t face) const {
    return model.materials[model.face_materials.empty() ? 0 : model.face_materials[face]];
  }

  template <class Any>
  bool any_material(Any const& any) const {
    return std::any_of(in_use.begin(), in_use.end(), [&](std::uint16_t m) { return any(model.materials[m]); });
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
    made.across = (made.corners[1] - made.corners[0]).cross(made.corners[2] - made.corners[0]).normalized();
    made.smooth = !model.normals.empty();
    if (made.smooth) made.normals = from_first(corners(model.normals, face));
    made.colours = {made.material->base_colour, Rgba{}, Rgba{}};
    if (!model.colours.empty()) made.colours = vertex_colours(face, made.material->base_colour);
    bool const coloured = !model.uvs.empty() && made.material->colour_map.image >= 0;
    if (coloured) made.colour_uvs = corner_uvs(made.material->colour_map, face);
    made.mapped = coloured || (!model.uvs.empty() && made.material->normal_map.image >= 0);
    return made;
  }

  static std::array<V3f, 3> from_first(std::array<V3f, 3> const& at) { return {at[0], at[1] - at[0], at[2] - at[0]}; }

  std::array<Rgba, 3> vertex_colours(std::uint32_t face, Rgba const& factor) const {
    auto const bytes = corners(model.colours, face);
    std::array<Rgba, 3> colours;
    for (int k = 0; k < 4; ++k) {
      float const scale = factor[k] * (1 / 65535.f);
      for (int c = 0; c < 3; ++c) colours[c][k] = float(bytes[c][k] - (c > 0 ? bytes[0][k] : 0)) * scale;
    }
    return colours;
  }

  static V3f vertex_normal(Facet const& facet, Barycentric const& at) {
    if (facet.smooth) {
      V3f const normal = facet.normals[0] + facet.normals[1] * at.u + facet.normals[2] * at.v;
      float const squared = normal.length2();
      if (squared > 1e-30f) return normal * (1 / std::sqrt(squared));
    }
    return facet.across;
  }

  /// As clients build it: from TANGENT where the file has it, else from the surface's own derivatives.
  TangentFrame frame(std::uint32_t face, Barycentric const& at, std::array<V3f, 3> const& p, CornerUvs const& uvs,
                     V3f const& normal) const {
    if (!model.tangents.empty()) {
      auto const t = corners(model.tangents, face);
      V4f const tangent = interpolate(t[0], t[1], t[2], at);
      V3f const direction(tangent.x, tangent.y, tangent.z);
      if (direction.length2() > 0) {
        TangentFrame stored = stored_frame(normal, direction.normalized());
        if (tangent.w < 0) stored.bitangent = -stored.bitangent;
        return stored;
      }
    }
    return client_frame(p, uvs, normal);
  }

  /// `texels(image, uvs)`: how many texels of the image the sample's footprint is across.
  template <class Texels>
  SurfaceSample sample(Facet const& facet, Barycentric const& at, Texels const& texels) const {
    SurfaceSample sample;
    for (int k = 0; k < 4; ++k)
      sample.colour[k] = facet.colours[0][k] + facet.colours[1][k] * at.u + facet.colours[2][k] * at.v;
    sample.normal = vertex_normal(facet, at);
    if (facet.mapped) add_maps(facet, at, texels, sample);
    sample.colour[3] = coverage(*facet.material, sample.colour[3]);
    return sample;
  }

  template <class Texels>
  void add_maps(Facet const& facet, Barycentric const& at, Texels const& texels, SurfaceSample& sample) const {
    Material const& material = *facet.material;
    auto const read = [&](TextureUse const& use, MipMaps const& maps, CornerUvs const& uvs) {
      float const squared = texels(model.images[use.image], uvs);
      float const level = squared > 1 ? std::log2(squared) / 2 : 0;
      return maps[use.image]->sample(interpolate(uvs[0], uvs[1], uvs[2], at), level, use.wrap_u, use.wrap_v);
    };
    if (material.colour_map.image >= 0)
      sample.colour = multiply(sample.colour, read(material.colour_map, colour_maps, facet.colour_uvs));
    if (material.normal_map.image >= 0) {
      CornerUvs const uvs = corner_uvs(material.normal_map, facet.face);
      Rgba const texel = read(material.normal_map, normal_maps, uvs);
      V3f const scale(material.normal_scale, material.normal_scale, 1);
      V3f const m = (V3f(texel[0], texel[1], texel[2]) * 2.f - V3f(1)) * scale;
      V3f const shown = from_tangent_space(frame(facet.face, at, facet.corners, uvs, sample.normal), m);
      if (shown.length2() > 0) sample.normal = shown;
    }
  }
};

Surface::Surface(SourceModel const& model) : impl_(std::make_unique<Impl>(model)) {}
Surface::~Surface() = default;
Surface::Surface(Surface&&) noexcept = default;
Surface& Surface::operator=(Surface&&) noexcept = default;

SurfaceSample Surface::sample(Hit const& hit, float footprint) const {
  Facet const facet = impl_->facet(hit.face);
  return impl_->sample(facet, {hit.u, hit.v}, [&](Image const& image, CornerUvs const& uvs) {
    auto const& p = facet.corners;
    float const area = (p[1] - p[0]).cross(p[2] - p[0]).length();
    float const texels = std::abs((uvs[1] - uvs[0]).cross(uvs[2] - uvs[0])) * float(image.width) * float(image.height);
    return footprint * footprint * texels / area;
  });
}

Facet Surface::facet(std::uint32_t face) const { return impl_->facet(face); }

SurfaceSample Surface::sample(Facet const& facet, Barycentric const& at,
                              std::array<Barycentric, 2> const& steps) const {
  return impl_->sample(facet, at, [&](Image const& image, CornerUvs const& uvs) {
    V2f const size(float(image.width), float(image.height));
    V2f const along_b = (uvs[1] - uvs[0]) * size, along_c = (uvs[2] - uvs[0]) * size;
    return std::max((along_b * steps[0].u + along_c * steps[0].v).length2(),
                    (along_b * steps[1].u + along_c * steps[1].v).length2());
  });
}

bool Surface::coloured() const {
  SourceModel const& model = impl_->model;
  if (!has_colour(model)) return false;
  Rgba const& first = model.materials[impl_->in_use[0]].base_colour;
  return (!model.colours.empty() && !all_equal(model.colours)) || impl_->any_material([&](Material const& material) {
    return (material.colour_map.image >= 0 && !model.uvs.empty()) || material.base_colour != first;
  });
}

Rgba Surface::uniform_colour() const {
  SourceModel const& model = impl_->model;
  if (!has_colour(model)) return {1, 1, 1, 1};
  Material const& material = model.materials[impl_->in_use[0]];
  Rgba colour = material.base_colour;
  if (!model.colours.empty()) colour = multiply(colour, to_float(model.colours[0]));
  colour[3] = coverage(material, colour[3]);
  return colour;
}

AlphaMode Surface::alpha() const {
  if (impl_->any_material([](Material const& m) { return m.alpha == AlphaMode::blend; })) return AlphaMode::blend;
  if (impl_->any_material([](Material const& m) { return m.alpha == AlphaMode::mask; })) return AlphaMode::mask;
  return AlphaMode::opaque;
}

bool Surface::unlit() const {
  return !impl_->any_material([](Material const& m) { return !m.unlit; });
}

bool Surface::double_sided() const {
  return impl_->any_material([](Material const& m) { return m.double_sided; });
}

SurveyedModel survey(std::shared_ptr<SourceModel const> model) {
  SourceModel const& held = *model;
  return {std::move(model), RayScene(held.mesh), Surface(held)};
}

}  // namespace vitrine
