// SPDX-License-Identifier: Apache-2.0
#include "stages/own_texture.h"

#include "stages/area_average.h"
#include "stages/clean.h"
#include "stages/plain_model.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace vitrine {
namespace {

constexpr float kMostRepetitions = 64;

struct PlacedUv {
  V3f position;
  V2f uv;
};

/// The one material that all faces are drawn as; nothing if they differ in what this file can hold one of.
std::optional<std::size_t> common_material(SourceModel const& model) {
  auto const look = [&](std::size_t m) {
    Material const& x = model.materials[m];
    return std::tie(x.colour_map.image, x.colour_map.matrix, x.colour_map.wrap_u, x.colour_map.wrap_v, x.base_colour,
                    x.alpha, x.alpha_cutoff);
  };
  std::size_t const first = model.face_materials.empty() ? 0 : model.face_materials.front();
  for (std::uint16_t m : model.face_materials)
    if (look(m) != look(first)) return {};
  return first;
}

bool alike(V2f const& a, V2f const& b) { return (a - b).length() <= kMostRepetitions; }

/// Vertices of one place and one coordinate become one.
TexturedMesh joined(std::vector<PlacedUv> const& vertices, std::vector<Triangle> const& triangles) {
  std::vector<unsigned> remap(vertices.size());
  std::size_t const count = meshopt_generateVertexRemap(remap.data(), nullptr, vertices.size(), vertices.data(),
                                                        vertices.size(), sizeof(PlacedUv));
  TexturedMesh out;
  out.mesh.positions.resize(count);
  out.uvs.resize(count);
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    out.mesh.positions[remap[v]] = vertices[v].position;
    out.uvs[remap[v]] = vertices[v].uv;
  }
  for (Triangle const& t : triangles) out.mesh.triangles.push_back({remap[t[0]], remap[t[1]], remap[t[2]]});
  return out;
}

bool is_thin(TriMesh const& mesh, Triangle const& t) {
  V3f const &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
  return a == b || b == c || c == a;
}

// ---- Coordinates in the unit square, and what the texture reads for them

struct UvFrame {
  V2f offset{0, 0}, scale{1, 1};
};

Imath::Box2f uv_bounds(std::vector<CornerUvs> const& corner_uvs) {
  Imath::Box2f box;
  for (CornerUvs const& corners : corner_uvs)
    for (V2f const& uv : corners) box.extendBy(uv);
  return box;
}

/// Whole repetitions, after which a texture looks the same.
float repetitions(float least, Wrap wrap) {
  constexpr float kRounding = 1e-4f;
  if (wrap == Wrap::clamp) return 0;
  return wrap == Wrap::repeat ? std::floor(least + kRounding) : 2 * std::floor((least + kRounding) / 2);
}

/// Moves the coordinates by whole repetitions, then into the unit square where they are not in it.
UvFrame frame(std::vector<CornerUvs>& corner_uvs, TextureUse const& use) {
  constexpr float kRounding = 1e-3f;
  Imath::Box2f const box = uv_bounds(corner_uvs);
  V2f const turns(repetitions(box.min.x, use.wrap_u), repetitions(box.min.y, use.wrap_v));
  V2f const least = box.min - turns, most = box.max - turns;
  bool const inside = std::min(least.x, least.y) >= -kRounding && std::max(most.x, most.y) <= 1 + kRounding;
  UvFrame out;
  if (!inside) out = {least, {std::max(most.x - least.x, 1e-6f), std::max(most.y - least.y, 1e-6f)}};
  for (CornerUvs& corners : corner_uvs)
    for (V2f& uv : corners) uv = (uv - turns - out.offset) / out.scale;
  return out;
}

/// Steps of a quarter of a texel or less.
int bits_for(double texels) { return std::clamp(int(std::bit_width(std::uint32_t(std::ceil(4 * texels)))), 8, 14); }

Image reduced(Image const& image, int longer_side) {
  double const scale = std::min(1.0, double(longer_side) / std::max(image.width, image.height));
  auto const side = [&](int length) { return std::max(1, int(std::lround(length * scale))); };
  return area_average(image, side(image.width), side(image.height));
}

}  // namespace

std::optional<TexturedMesh> own_texture(SourceModel const& model) {
  std::optional<std::size_t> const material = common_material(model);
  if (!material || model.uvs.empty() || !model.colours.empty() || emits(model.materials[*material])) return {};
  TextureUse const& use = model.materials[*material].colour_map;
  if (use.image < 0) return {};
  std::array<float, 6> const& m = use.matrix;
  std::vector<PlacedUv> vertices;
  vertices.reserve(model.uvs.size());
  for (std::size_t v = 0; v < model.uvs.size(); ++v) {
    V2f const& uv = model.uvs[v];
    // + 0: negative zero is another key
    vertices.push_back(
        {model.mesh.positions[v] + V3f(0), {m[0] * uv.x + m[1] * uv.y + m[2], m[3] * uv.x + m[4] * uv.y + m[5]}});
    if (!alike(vertices.front().uv, vertices.back().uv)) return {};
  }
  TexturedMesh out = joined(vertices, model.mesh.triangles);
  out.material = *material;
  return out;
}

Image const& own_image(SourceModel const& model, TexturedMesh const& textured) {
  return model.images[std::size_t(model.materials[textured.material].colour_map.image)];
}

SimplifiedMesh simplify(TexturedMesh const& textured, int triangles) {
  TriMesh const& mesh = textured.mesh;
  std::vector<Triangle> faces(mesh.triangles.size());
  std::size_t const target = std::min(faces.size(), std::size_t(triangles));  // more would stop the library
  std::size_t const indices = meshopt_simplify(
      faces.front().data(), mesh.triangles.front().data(), 3 * mesh.triangles.size(), mesh.positions.front().getValue(),
      mesh.positions.size(), sizeof(V3f), 3 * target, std::numeric_limits<float>::max());
  faces.resize(indices / 3);
  std::erase_if(faces, [&](Triangle const& t) { return is_thin(mesh, t); });

  SimplifiedMesh out;
  SourceModel split;
  split.mesh = {mesh.positions, faces};
  out.mesh = weld(split);
  for (auto const& [a, b, c] : faces) out.corner_uvs.push_back({textured.uvs[a], textured.uvs[b], textured.uvs[c]});
  return out;
}

BakedModel wear_own_texture(SimplifiedMesh const& light, TexturedMesh const& textured, SurveyedModel const& original,
                            SurfaceSamples const& samples, OwnTextureOptions const& options) {
  Material const& material = original.model->materials[textured.material];
  TextureUse const& use = material.colour_map;
  Image image = reduced(own_image(*original.model, textured), options.texture);
  Atlas atlas{light.mesh,  std::vector<std::uint32_t>(light.mesh.triangles.size(), 0), 1, light.corner_uvs, image.width,
              image.height};
  UvFrame const uv = frame(atlas.corner_uvs, use);
  int const bits =
      bits_for(std::max(double(image.width) * double(uv.scale.x), double(image.height) * double(uv.scale.y)));
  QuantizedAtlas placed = quantize(std::move(atlas), {options.position_bits, bits, options.normal_bits});

  BakedModel model = plain_model(placed.atlas.mesh, placed.grid, original);
  model.corner_uvs = std::move(placed.atlas.corner_uvs);
  model.uv_offset = uv.offset;
  model.uv_scale = uv.scale;
  model.wrap_u = use.wrap_u;
  model.wrap_v = use.wrap_v;
  model.base_colour = material.base_colour;
  model.colour = std::move(image);
  model.alpha = material.alpha;
  model.alpha_cutoff = material.alpha_cutoff;
  if (options.normals && !model.unlit)
    wear_normals(model, original, samples, {.creases = options.creases, .normal_bits = options.normal_bits});
  return model;
}

}  // namespace vitrine
