// SPDX-License-Identifier: Apache-2.0
#include "io/gltf_file.h"

#include "io/gltf_compression.h"
#include "io/stand_in.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

namespace vitrine::io {
namespace {

std::uint32_t word_at(std::span<std::byte const> bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < 4; ++k) value |= std::to_integer<std::uint32_t>(bytes[at + k]) << 8 * k;
  return value;
}

/// Six bits of base64, also of its URL form; -1 for what is no digit.
int base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+' || c == '-') return 62;
  return c == '/' || c == '_' ? 63 : -1;
}

std::vector<std::byte> base64(std::string_view text) {
  std::vector<std::byte> bytes;
  bytes.reserve(text.size() / 4 * 3);
  while (text.ends_with('=')) text.remove_suffix(1);
  std::uint32_t bits = 0;
  int count = 0;
  for (char c : text) {
    int const digit = base64_digit(c);
    if (digit < 0) refuse_gltf("a data URI is not base64");
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(std::byte(bits >> count & 0xFF));
  }
  return bytes;
}

GltfJson parse_json(std::string_view text) {
  text = without_mark(text);
  try {
    GltfJson json = GltfJson::parse(text.begin(), text.end());
    if (!json.is_object()) refuse_gltf("its JSON is no object");
    return json;
  } catch (GltfJson::parse_error const& error) {
    refuse_gltf("its JSON breaks off or is damaged at byte " + std::to_string(error.byte) + " of " +
                std::to_string(text.size()));
  } catch (GltfJson::exception const&) {
    refuse_gltf("its JSON holds a number beyond range");
  }
}

/// Material extensions change the finish, lights are not drawn: such files are read without.
bool is_read(std::string_view extension) {
  static constexpr std::array<std::string_view, 9> known{
      "KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_mesh_quantization",
      "KHR_texture_transform",      "EXT_mesh_gpu_instancing", "EXT_texture_webp",
      "EXT_texture_avif",           "KHR_lights_punctual",     "KHR_xmp_json_ld"};
  return extension.starts_with("KHR_materials_") || std::find(known.begin(), known.end(), extension) != known.end();
}

}  // namespace

GltfFile::GltfFile(Blob file, Resolve const& resolve, ReadLimits const& limits)
    : file_(std::move(file)), resolve_(resolve), limits_(limits), bytes_present_(file_.bytes.size()) {
  open_container();
  std::string const version = member(json_, "asset") ? string(*member(json_, "asset"), "version") : "";
  if (version.starts_with("1."))
    throw Error(ErrorKind::unsupported, "glTF " + version + " is not read, only 2.0", "convert the file to glTF 2.0");
  check_extensions();
}

/// Source: glTF 2.0 specification, section 4.4, "GLB file format".
void GltfFile::open_container() {
  std::span<std::byte const> const bytes = file_.bytes;
  if (!characters(bytes).starts_with("glTF")) {
    json_ = parse_json(characters(bytes));
    return;
  }
  if (bytes.size() < 20) refuse_gltf("the file ends in its GLB header");
  if (word_at(bytes, 4) != 2)
    throw Error(ErrorKind::unsupported, "GLB version " + std::to_string(word_at(bytes, 4)) + " is not read, only 2",
                "convert the file to glTF 2.0");
  std::size_t const length = word_at(bytes, 8);
  if (length > bytes.size() || length < 20)
    refuse_gltf("its header tells of " + std::to_string(length) + " bytes, the file has " +
                std::to_string(bytes.size()));
  bool first = true;
  for (std::size_t at = 12; at + 8 <= length; first = false) {
    std::size_t const size = word_at(bytes, at), kind = word_at(bytes, at + 4);
    if (size > length - at - 8)
      refuse_gltf("GLB chunk of " + std::to_string(size) + " bytes, of which " + std::to_string(length - at - 8) +
                  " are there");
    std::span<std::byte const> const chunk = bytes.subspan(at + 8, size);
    constexpr std::uint32_t json = 0x4E4F534A, binary = 0x004E4942;
    if (first != (kind == json)) refuse_gltf("the GLB's first chunk and no other must be JSON");
    if (first) json_ = parse_json(characters(chunk));
    if (kind == binary && binary_chunk_.empty()) binary_chunk_ = chunk;
    at += 8 + size;
  }
}

void GltfFile::check_extensions() const {
  for (GltfJson const& name : list(json_, "extensionsRequired"))
    if (!name.is_string() || !is_read(name.get<std::string>()))
      throw Error(ErrorKind::unsupported, "glTF extension " + name.dump() + " is required and not read here",
                  "export the model without this extension");
}

bool GltfFile::uses(std::string_view extension) const {
  for (char const* key : {"extensionsUsed", "extensionsRequired"})
    for (GltfJson const& name : list(json_, key))
      if (name.is_string() && name.get<std::string>() == extension) return true;
  return false;
}

GltfJson const& GltfFile::item(char const* collection, std::uint64_t index) const {
  GltfJson const& items = list(json_, collection);
  if (index >= items.size())
    refuse_gltf(std::string(collection) + "[" + std::to_string(index) + "] of " + std::to_string(items.size()));
  return items[index];
}

std::optional<Blob> GltfFile::fetch(std::string const& uri) const {
  if (!uri.starts_with("data:")) return resolve_(uri);
  std::size_t const comma = uri.find(',');
  if (comma == std::string::npos || uri.substr(0, comma).find(";base64") == std::string::npos)
    refuse_gltf("a data URI is not base64");
  return own(base64(std::string_view(uri).substr(comma + 1)));
}

std::span<std::byte const> GltfFile::buffer(std::uint64_t index) {
  GltfJson const& description = item("buffers", index);
  std::uint64_t const length = required(description, "byteLength");
  std::span<std::byte const> bytes = binary_chunk_;
  if (std::string const uri = string(description, "uri"); !uri.empty()) {
    auto found = buffers_.find(index);
    if (found == buffers_.end()) {
      std::optional<Blob> blob = fetch(uri);
      if (!blob)
        throw Error(ErrorKind::invalid_input,
                    "the file \"" + uri.substr(0, 200) + "\", which holds the geometry, is missing",
                    "put it beside the model");
      refuse_stand_in(blob->bytes, "file \"" + uri.substr(0, 200) + "\"");
      bytes_present_ += blob->bytes.size();
      found = buffers_.emplace(index, std::move(*blob)).first;
    }
    bytes = found->second.bytes;
  } else if (index != 0) {
    bytes = {};
  }
  if (length > bytes.size())
    refuse_gltf("buffers[" + std::to_string(index) + "] of " + std::to_string(length) + " bytes, of which " +
                std::to_string(bytes.size()) + " are there");
  return bytes.first(length);
}

std::span<std::byte const> GltfFile::slice(std::uint64_t buffer_index, GltfJson const& view) {
  std::span<std::byte const> const bytes = buffer(buffer_index);
  std::uint64_t const offset = whole(view, "byteOffset").value_or(0), length = required(view, "byteLength");
  if (offset > bytes.size() || length > bytes.size() - offset)
    refuse_gltf("a buffer view of " + std::to_string(length) + " bytes from " + std::to_string(offset) +
                " in a buffer of " + std::to_string(bytes.size()));
  return bytes.subspan(offset, length);
}

BufferView GltfFile::view(std::uint64_t index) {
  GltfJson const& description = item("bufferViews", index);
  std::size_t const stride = whole(description, "byteStride").value_or(0);
  if (stride > 252)
    refuse_gltf("bufferViews[" + std::to_string(index) + "] has a byteStride of " + std::to_string(stride) +
                ", above 252");
  if (GltfJson const* const meshopt = extension(description, "EXT_meshopt_compression"))
    return {decompressed(index, *meshopt), stride};
  return {slice(required(description, "buffer"), description), stride};
}

std::span<std::byte const> GltfFile::decompressed(std::uint64_t index, GltfJson const& meshopt) {
  auto found = decompressed_.find(index);
  if (found == decompressed_.end()) {
    MeshoptStream const stream{slice(required(meshopt, "buffer"), meshopt), required(meshopt, "count"),
                               required(meshopt, "byteStride"), string(meshopt, "mode"), string(meshopt, "filter")};
    std::vector<std::byte> bytes = decode_meshopt(stream, limits_.bytes - bytes_decompressed_);
    bytes_decompressed_ += bytes.size();
    found = decompressed_.emplace(index, std::move(bytes)).first;
  }
  return found->second;
}

}  // namespace vitrine::io
