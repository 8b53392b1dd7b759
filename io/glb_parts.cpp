// SPDX-License-Identifier: Apache-2.0
#include "io/glb_parts.h"

#include "stages/error.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace vitrine::io {
namespace {

using Json = nlohmann::json;

[[noreturn]] void refuse(std::string const& what) {
  throw Error(ErrorKind::invalid_input, what, "check the file with the Khronos glTF validator");
}

std::uint32_t word(std::span<std::byte const> bytes, std::size_t offset) {
  std::uint32_t value;
  std::memcpy(&value, &bytes[offset], sizeof value);
  return value;
}

Json json_chunk(std::span<std::byte const> glb) {
  constexpr std::size_t header = 20;  // of the file and of the first chunk
  constexpr std::uint32_t magic = 0x46546c67, json = 0x4e4f534a;
  if (glb.size() < header || word(glb, 0) != magic || word(glb, 16) != json) refuse("not a GLB file");
  std::size_t const length = word(glb, 12);
  if (length > glb.size() - header)
    refuse("the JSON of the GLB takes " + std::to_string(length) + " of " + std::to_string(glb.size() - header) +
           " bytes");
  auto const* text = reinterpret_cast<char const*>(glb.data()) + header;
  Json document = Json::parse(text, text + length, nullptr, false);
  if (!document.is_object()) refuse("the JSON of the GLB is damaged");
  return document;
}

/// The list under a key; empty where it is missing or something else.
Json const& list(Json const& object, char const* key) {
  static Json const none = Json::array();
  if (!object.is_object()) return none;
  auto const found = object.find(key);
  return found != object.end() && found->is_array() ? *found : none;
}

/// The value at a path of keys; null where there is none.
Json const& at(Json const& object, std::initializer_list<char const*> path) {
  static Json const none;
  Json const* value = &object;
  for (char const* key : path) {
    if (!value->is_object() || !value->contains(key)) return none;
    value = &(*value)[key];
  }
  return *value;
}

/// An index or a size, below `end`; `end` where it is neither.
std::size_t number_below(Json const& value, std::size_t end) {
  return value.is_number_unsigned() && value.get<std::uint64_t>() < end ? value.get<std::size_t>() : end;
}

using Part = std::size_t GlbParts::*;

/// The image that a texture shows: a better codec's where an extension names one.
std::size_t image_of(Json const& document, Json const& texture_info) {
  Json const &textures = list(document, "textures"), &images = list(document, "images");
  std::size_t const texture = number_below(at(texture_info, {"index"}), textures.size());
  if (texture == textures.size()) return images.size();
  for (char const* extension : {"EXT_texture_avif", "EXT_texture_webp", "KHR_texture_basisu"}) {
    std::size_t const image = number_below(at(textures[texture], {"extensions", extension, "source"}), images.size());
    if (image < images.size()) return image;
  }
  return number_below(at(textures[texture], {"source"}), images.size());
}

/// For each buffer view what it is: images by their first use, everything else geometry.
std::vector<Part> parts_of_views(Json const& document) {
  Json const &views = list(document, "bufferViews"), &images = list(document, "images");
  std::vector<Part> of_image(images.size(), &GlbParts::other), of_view(views.size(), &GlbParts::geometry);
  auto const use = [&](Json const& texture_info, Part part) {
    std::size_t const image = image_of(document, texture_info);
    if (image < images.size() && of_image[image] == &GlbParts::other) of_image[image] = part;
  };
  for (Json const& material : list(document, "materials")) {
    use(at(material, {"pbrMetallicRoughness", "baseColorTexture"}), &GlbParts::colour);
    use(at(material, {"normalTexture"}), &GlbParts::normal);
    use(at(material, {"occlusionTexture"}), &GlbParts::occlusion);
  }
  for (std::size_t i = 0; i < images.size(); ++i) {
    std::size_t const view = number_below(at(images[i], {"bufferView"}), views.size());
    if (view < views.size()) of_view[view] = of_image[i];
  }
  return of_view;
}

}  // namespace

GlbParts glb_parts(std::span<std::byte const> glb) {
  Json const document = json_chunk(glb);
  std::vector<Part> const of_view = parts_of_views(document);
  GlbParts parts;
  parts.other = glb.size();
  for (std::size_t i = 0; i < of_view.size(); ++i) {
    Json const& view = list(document, "bufferViews")[i];
    Json const& compressed = at(view, {"extensions", "EXT_meshopt_compression", "byteLength"});
    Json const& length = compressed.is_null() ? at(view, {"byteLength"}) : compressed;
    std::size_t const bytes = number_below(length, parts.other + 1);
    if (bytes > parts.other)
      refuse("the buffer views of the GLB claim more than its " + std::to_string(glb.size()) + " bytes");
    parts.other -= bytes;
    parts.*of_view[i] += bytes;
  }
  return parts;
}

}  // namespace vitrine::io
