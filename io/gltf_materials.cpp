// SPDX-License-Identifier: Apache-2.0
#include "io/gltf_materials.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace vitrine::io {
namespace {

bool is_mipmapped(GltfJson const* sampler) {
  constexpr std::uint64_t nearest = 9728, linear = 9729, trilinear = 9987;
  std::uint64_t const filter = sampler ? whole(*sampler, "minFilter").value_or(trilinear) : trilinear;
  return filter != nearest && filter != linear;
}

Filter filter_of(GltfJson const* sampler, char const* key) {
  constexpr std::uint64_t nearest = 9728, linear = 9729, nearest_of_nearest = 9984, nearest_between_levels = 9986;
  std::uint64_t const filter = sampler ? whole(*sampler, key).value_or(linear) : linear;
  bool const is_nearest = filter == nearest || filter == nearest_of_nearest || filter == nearest_between_levels;
  return is_nearest ? Filter::nearest : Filter::linear;
}

Wrap wrap_of(GltfJson const* sampler, char const* key) {
  std::uint64_t const mode = sampler ? whole(*sampler, key).value_or(10497) : 10497;
  if (mode == 33071) return Wrap::clamp;
  return mode == 33648 ? Wrap::mirror : Wrap::repeat;
}

/// Scale, then turn anticlockwise about (0, 0) as seen with v downwards, then shift. Source: KHR_texture_transform.
std::array<float, 6> uv_matrix(GltfJson const& transform) {
  auto const offset = reals<2>(transform, "offset", {0, 0}), scale = reals<2>(transform, "scale", {1, 1});
  double const turn = real(transform, "rotation", 0), c = std::cos(turn), s = std::sin(turn);
  auto const f = [](double value) { return static_cast<float>(value); };
  return {f(c * scale[0]), f(s * scale[1]), f(offset[0]), f(-s * scale[0]), f(c * scale[1]), f(offset[1])};
}

std::uint64_t uv_set_of(GltfJson const& texture_info) {
  GltfJson const* const transform = extension(texture_info, "KHR_texture_transform");
  std::optional<std::uint64_t> const moved = transform ? whole(*transform, "texCoord") : std::nullopt;
  return moved ? *moved : whole(texture_info, "texCoord").value_or(0);
}

/// Whether the factor is another colour than white when shown with 8 bits: (254.5 / 255) in linear light.
bool is_tint(Rgba const& factor) {
  return std::any_of(factor.begin(), factor.begin() + 3, [](float c) { return c < 0.99554f; });
}

Rgba colour_of(std::array<double, 4> const& factor) {
  Rgba colour;
  std::transform(factor.begin(), factor.end(), colour.begin(),
                 [](double c) { return static_cast<float>(std::clamp(c, 0.0, 1.0)); });
  return colour;
}

void read_alpha(GltfJson const& description, Material& material) {
  std::string const mode = string(description, "alphaMode");
  material.alpha = mode == "MASK" ? AlphaMode::mask : mode == "BLEND" ? AlphaMode::blend : AlphaMode::opaque;
  material.alpha_cutoff = static_cast<float>(real(description, "alphaCutoff", 0.5));
}

/// What only emits looks the same from everywhere under any light.
void read_as_unlit(Material& material) {
  material.unlit = true;
  for (unsigned k = 0; k < 3; ++k) material.base_colour[k] = std::min(material.emission[k], 1.f);
  material.colour_map = std::exchange(material.emission_map, {});
  material.normal_map = {};
}

}  // namespace

GltfMaterials::Entry GltfMaterials::take(std::optional<std::uint64_t> number) {
  if (auto const found = taken_.find(number); found != taken_.end()) return found->second;
  if (taken_.empty()) model_.materials.clear();
  if (model_.materials.size() > std::numeric_limits<std::uint16_t>::max())
    throw Error(ErrorKind::limit_exceeded, "more than 65536 materials", "merge materials before");
  Entry entry;
  entry.index = static_cast<std::uint16_t>(model_.materials.size());
  model_.materials.push_back(number ? read(gltf_.item("materials", *number), entry) : Material{});
  taken_.emplace(number, entry);
  return entry;
}

Material GltfMaterials::read(GltfJson const& description, Entry& entry) {
  Material material;
  std::uint64_t& uv_set = entry.uv_set;
  material.name = string(description, "name");
  GltfJson const* factors = member(description, "pbrMetallicRoughness");
  char const *factor_key = "baseColorFactor", *map_key = "baseColorTexture";
  if (GltfJson const* const glossy = extension(description, "KHR_materials_pbrSpecularGlossiness");
      glossy && !factors) {
    factors = glossy;
    factor_key = "diffuseFactor";
    map_key = "diffuseTexture";
    model_.notes.push_back("material \"" + material.name +
                           "\": the diffuse colour of its specular-glossiness model is drawn");
  }
  GltfJson const* const colour_map = factors ? member(*factors, map_key) : nullptr;
  GltfJson const* const normal_map = member(description, "normalTexture");
  if (factors) material.base_colour = colour_of(reals<4>(*factors, factor_key, {1, 1, 1, 1}));
  if (colour_map) material.colour_map = use(*colour_map, ColourSpace::srgb);
  if (colour_map || normal_map) uv_set = uv_set_of(colour_map ? *colour_map : *normal_map);
  if (normal_map && uv_set_of(*normal_map) != uv_set)
    model_.notes.push_back("normal map of material \"" + material.name +
                           "\" left out: it has texture coordinates of its own");
  else if (normal_map)
    material.normal_map = use(*normal_map, ColourSpace::linear);
  if (normal_map) material.normal_scale = static_cast<float>(real(*normal_map, "scale", 1));
  if (GltfJson const* const map = occlusion_maps_ ? member(description, "occlusionTexture") : nullptr)
    read_occlusion(*map, !colour_map && !normal_map, material, uv_set);
  read_alpha(description, material);
  material.unlit = extension(description, "KHR_materials_unlit") != nullptr;
  if (!material.unlit) read_emission(description, !colour_map && !normal_map, material, entry);
  material.coloured =
      material.colour_map.image >= 0 || material.emission_map.image >= 0 || is_tint(material.base_colour);
  material.double_sided = flag(description, "doubleSided");
  return material;
}

/// `alone`: no other texture has chosen the material's texture coordinates.
void GltfMaterials::read_emission(GltfJson const& description, bool alone, Material& material, Entry& entry) {
  GltfJson const* const brighter = extension(description, "KHR_materials_emissive_strength");
  double const strength = brighter ? std::clamp(real(*brighter, "emissiveStrength", 1), 0.0, 1e6) : 1;
  auto const factor = reals<3>(description, "emissiveFactor", {0, 0, 0});
  for (unsigned k = 0; k < 3; ++k)
    material.emission[k] = static_cast<float>(strength * std::clamp(factor[k], 0.0, 1.0));
  GltfJson const* const map = member(description, "emissiveTexture");
  if (!emits(material)) return;
  if (map && alone) entry.uv_set = uv_set_of(*map);
  if (map && uv_set_of(*map) != entry.uv_set) {
    model_.notes.push_back("emission of material \"" + material.name +
                           "\" left out: it has texture coordinates of its own");
    material.emission = V3f(0);
    return;
  }
  if (map) material.emission_map = use(*map, ColourSpace::srgb);
  Rgba const& base = material.base_colour;
  entry.only_emits = base[0] + base[1] + base[2] == 0 && material.alpha == AlphaMode::opaque;
  if (entry.only_emits) read_as_unlit(material);
}

/// `alone`: as above.
void GltfMaterials::read_occlusion(GltfJson const& map, bool alone, Material& material, std::uint64_t& uv_set) {
  if (alone) uv_set = uv_set_of(map);
  if (uv_set_of(map) != uv_set) {
    model_.notes.push_back("occlusion map of material \"" + material.name +
                           "\" left out: it has texture coordinates of its own");
    return;
  }
  material.occlusion_map = use(map, ColourSpace::linear);
  material.occlusion_strength = static_cast<float>(std::clamp(real(map, "strength", 1), 0.0, 1.0));
}

/// AVIF or WebP where the file offers it, else what it offers everybody.
std::optional<std::uint64_t> GltfMaterials::image_of(GltfJson const& texture) const {
  for (char const* name : {"EXT_texture_avif", "EXT_texture_webp"})
    if (GltfJson const* const better = extension(texture, name)) return whole(*better, "source");
  return whole(texture, "source");
}

TextureUse GltfMaterials::use(GltfJson const& info, ColourSpace space) {
  GltfJson const& texture = gltf_.item("textures", required(info, "index"));
  TextureUse result;
  std::optional<std::uint64_t> const source = image_of(texture);
  if (!source) {
    model_.notes.push_back("a texture left out: none of its image formats is read");
    return result;
  }
  GltfJson const& image = gltf_.item("images", *source);
  std::string const uri = string(image, "uri");
  std::string const name = uri.empty() || uri.starts_with("data:") ? "image " + std::to_string(*source) : uri;
  result.image = textures_.take(name, space, [&]() -> std::optional<Blob> {
    if (!uri.empty()) return gltf_.fetch(uri);
    return Blob{gltf_.view(required(image, "bufferView")).bytes, nullptr};
  });
  std::optional<std::uint64_t> const sampler = whole(texture, "sampler");
  GltfJson const* const modes = sampler ? &gltf_.item("samplers", *sampler) : nullptr;
  result.wrap_u = wrap_of(modes, "wrapS");
  result.wrap_v = wrap_of(modes, "wrapT");
  result.magnified = filter_of(modes, "magFilter");
  result.minified = filter_of(modes, "minFilter");
  result.mipmapped = is_mipmapped(modes);
  if (GltfJson const* const transform = extension(info, "KHR_texture_transform")) result.matrix = uv_matrix(*transform);
  return result;
}

}  // namespace vitrine::io
