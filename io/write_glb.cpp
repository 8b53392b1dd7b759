// SPDX-License-Identifier: Apache-2.0
#include "io/write_glb.h"

#include "io/colour_map.h"
#include "io/gltf_geometry.h"
#include "io/map_codec.h"
#include "io/write_x3d.h"
#include "io/zip.h"
#include "stages/error.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace vitrine::io {
namespace {

WrittenGeometry write_geometry(GltfDocument& document, VertexMesh const& mesh, Grid const& grid, Profile profile) {
  switch (profile) {
    case Profile::plain:
      return write_buffers(document, mesh, grid);
    case Profile::meshopt:
      return write_meshopt(document, mesh, grid);
    case Profile::core:
      return write_floats(document, mesh);
    default:
      return write_draco(document, mesh, grid);
  }
}

/// Embeds a coded map; returns its glTF reference and adds its bytes to `bytes`.
Json write_map(GltfDocument& document, EncodedImage const& coded, std::size_t& bytes) {
  bytes += coded.bytes.size();
  std::size_t const source =
      add(document.json, "images", {{"bufferView", document.add_view(coded.bytes)}, {"mimeType", coded.mime}});
  Json texture = {{"source", source}};
  if (coded.mime == "image/webp" || coded.mime == "image/avif") {
    std::string const extension = "EXT_texture_" + std::string(coded.mime.substr(coded.mime.find('/') + 1));
    document.use_extension(extension, Need::required);
    texture = {{"extensions", {{extension, std::move(texture)}}}};
  }
  return {{"index", add(document.json, "textures", std::move(texture))}};
}

/// Five decimals: finer than 8-bit sRGB everywhere.
Json colour_factor(Rgba const& colour) {
  Json list = Json::array();
  for (float c : colour) list.push_back(number(std::round(1e5 * std::clamp<double>(c, 0, 1)) / 1e5));
  return list;
}

/// A palette is stored without loss, and clients must read it as it is: smaller versions of it mix colours from all
/// over.
Json write_palette(GltfDocument& document, Image const& palette, std::size_t& bytes) {
  constexpr int kLinear = 9729;
  document.json["samplers"][0]["minFilter"] = kLinear;
  Json map = write_map(document, encode_image(palette, {ImageCodec::png}), bytes);
  document.json["textures"][map["index"].get<std::size_t>()]["sampler"] = 0;
  return map;
}

int gl_name(Wrap wrap) {
  switch (wrap) {
    case Wrap::mirror:
      return 33648;
    case Wrap::clamp:
      return 33071;
    default:
      return 10497;
  }
}

/// The original's own texture may repeat, and be read elsewhere than in the unit square.
Json write_colour_map(GltfDocument& document, BakedModel const& model, EncodedImage const& coded, std::size_t& bytes) {
  Json map = write_map(document, coded, bytes);
  if (model.wrap_u != Wrap::repeat || model.wrap_v != Wrap::repeat) {
    document.json["samplers"][0] = {{"wrapS", gl_name(model.wrap_u)}, {"wrapT", gl_name(model.wrap_v)}};
    document.json["textures"][map["index"].get<std::size_t>()]["sampler"] = 0;
  }
  if (model.uv_offset != V2f(0, 0) || model.uv_scale != V2f(1, 1)) {
    document.use_extension("KHR_texture_transform", Need::required);
    auto const pair = [](V2f const& v) { return Json::array({number(v.x), number(v.y)}); };
    map["extensions"]["KHR_texture_transform"] = {{"offset", pair(model.uv_offset)}, {"scale", pair(model.uv_scale)}};
  }
  return map;
}

/// `colour`: the colour map as coded, where there is one.
Json write_material(GltfDocument& document, BakedModel const& model, EncodedImage const& colour,
                    EncodeOptions const& options, EncodedThumbnail& sizes) {
  Json pbr = {{"metallicFactor", 0}};
  if (Json factor = colour_factor(model.base_colour); factor != Json::array({1, 1, 1, 1}))
    pbr["baseColorFactor"] = std::move(factor);
  if (model.colour)
    pbr["baseColorTexture"] = model.palette ? write_palette(document, *model.colour, sizes.colour)
                                            : write_colour_map(document, model, colour, sizes.colour);
  Json material = {{"pbrMetallicRoughness", std::move(pbr)}};
  if (model.normal) {
    EncodedImage const normal = encode_normal(*model.normal, options);
    sizes.normal_map = decode_image(normal.bytes, ColourSpace::linear);
    material["normalTexture"] = write_map(document, normal, sizes.normal);
  }
  if (model.occlusion)
    material["occlusionTexture"] = write_map(document, code_colour(*model.occlusion, options).image, sizes.occlusion);
  if (model.alpha == AlphaMode::blend) material["alphaMode"] = "BLEND";
  if (model.alpha == AlphaMode::mask) {
    material["alphaMode"] = "MASK";
    if (model.alpha_cutoff != 0.5f) material["alphaCutoff"] = number(model.alpha_cutoff);
  }
  if (model.double_sided) material["doubleSided"] = true;
  if (model.unlit) {
    document.use_extension("KHR_materials_unlit", Need::optional);
    material["extensions"]["KHR_materials_unlit"] = Json::object();
  }
  return material;
}

/// "scene" is stated, though it costs ten bytes: some importers show nothing without it.
void write_scene(GltfDocument& document, WrittenGeometry const& geometry, V3d const& origin, std::string_view title) {
  Json node = {{"mesh", 0}};
  if (!title.empty()) node["name"] = title;
  V3d const translation = origin + V3d(geometry.translation);
  if (geometry.scale != 1) node["scale"] = numbers(V3f(geometry.scale));
  if (translation != V3d(0, 0, 0))
    node["translation"] = origin == V3d(0, 0, 0) ? numbers(geometry.translation) : numbers(translation);
  document.json["scene"] = 0;
  document.json["scenes"][0]["nodes"] = Json::array({0});
  document.json["nodes"][0] = std::move(node);
}

EncodedThumbnail finish(GltfDocument& document, WrittenGeometry const& geometry, BakedModel const& model,
                        EncodedImage const& colour, EncodeOptions const& options) {
  EncodedThumbnail thumbnail;
  document.json["materials"][0] = write_material(document, model, colour, options, thumbnail);
  Json primitive = geometry.primitive;
  primitive["material"] = 0;
  document.json["meshes"][0]["primitives"][0] = std::move(primitive);
  thumbnail.glb = document.glb();
  thumbnail.geometry = geometry.bytes;
  thumbnail.other =
      thumbnail.glb.size() - thumbnail.geometry - thumbnail.colour - thumbnail.normal - thumbnail.occlusion;
  thumbnail.triangles = geometry.triangles;
  thumbnail.vertices = geometry.vertices;
  return thumbnail;
}

/// Of the file without the colour map's own bytes; where its size has more digits, JSON has too.
std::size_t bytes_beside_colour(EncodedThumbnail const& without) {
  constexpr std::size_t kDigits = 16;
  return without.glb.size() + kDigits;
}

}  // namespace

EncodedImage encode_normal(Image const& map, EncodeOptions const& options) {
  ImageCodec const usual = common_maps(options.profile) ? ImageCodec::png : ImageCodec::webp;
  if (std::optional<ImageCodec> const codec = codec_asked_for(options.normal_codec))
    return encode_image(map, {*codec, options.normal_quality, true, Effort::utmost});
  return encode_map(map, {usual, options.normal_quality});
}

EncodedThumbnail encode(BakedModel const& model, std::string_view title, EncodeOptions const& options,
                        std::size_t most_bytes) {
  if (model.mesh.triangles.empty())
    throw Error(ErrorKind::broken, "nothing to encode: no triangles are left", "report this model");
  GltfDocument geometry_alone;
  WrittenGeometry const geometry = write_geometry(geometry_alone, split_vertices(model), model.grid, options.profile);
  write_scene(geometry_alone, geometry, model.origin, title);
  auto const with_colour = [&](EncodedImage const& colour) {
    GltfDocument document = geometry_alone;
    return finish(document, geometry, model, colour, options);
  };
  CodedColour colour;
  if (model.colour && !model.palette) {
    std::size_t const rest = bytes_beside_colour(with_colour({"image/webp", {}}));
    colour = most_bytes == kAnySize
                 ? code_colour(*model.colour, options)
                 : code_colour_within(most_bytes - std::min(rest, most_bytes), *model.colour, options);
  }
  EncodedThumbnail thumbnail = with_colour(colour.image);
  thumbnail.colour_quality = colour.quality;
  if (options.x3dom) {
    EncodeOptions same_map = options;
    if (colour.quality > 0) same_map.colour_quality = colour.quality;
    thumbnail.x3d = write_x3d(model, title, same_map);
    thumbnail.x3d_zip = zip(thumbnail.x3d);
  }
  return thumbnail;
}

}  // namespace vitrine::io
