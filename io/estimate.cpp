// SPDX-License-Identifier: Apache-2.0
#include "io/archive.h"
#include "io/gltf_file.h"
#include "io/image_codec.h"
#include "io/ply_header.h"
#include "io/read_mtl.h"
#include "io/text_scanner.h"

#include <algorithm>
#include <cstring>
#include <exception>
#include <set>
#include <string>
#include <vector>

namespace vitrine::io {
namespace {

/// What one model takes at the pipeline's peak, over what the program itself holds. Measured on whole runs over bust,
/// amphora, mask and mosaic of the sample archive at 0.25, 1 and 4 million triangles: 225 to 250 bytes a triangle.
struct MemoryModel {
  static constexpr std::uint64_t base = 40'000'000;
  static constexpr std::uint64_t per_triangle = 280;
  /// Of a large scan without textures, which is thinned first: coloured PLY of 28 million triangles took 46 bytes a
  /// triangle, its file in memory included; three vertices a triangle, as in STL, take 60 more.
  static constexpr std::uint64_t thinned_base = 250'000'000, per_thinned = 60, per_split = 70;
  static constexpr std::uint64_t per_texel = 4;
  static constexpr std::uint64_t per_image_byte = 12;  ///< of images whose header tells nothing: JPEG at 3 bits a texel
};

/// Bytes of file that the shortest triangle of each format takes: no count is believed beyond.
constexpr std::uint64_t kPlyBytes = 4, kOffBytes = 6, kStlBytes = 50, kAsciiStlBytes = 200;
/// Where nothing can be counted.
constexpr std::uint64_t kObjBytes = 60, kGltfBytes = 24;

struct Census {
  std::uint64_t triangles = 0;
  std::uint64_t image_memory = 0;
  std::uint64_t per_thinned = 0;  ///< bytes a triangle where a large scan is thinned; 0: it may have textures
};

std::uint64_t image_memory(std::span<std::byte const> bytes) {
  try {
    ImageSize const size = image_size(bytes);
    return static_cast<std::uint64_t>(size.width) * static_cast<std::uint64_t>(size.height) * MemoryModel::per_texel;
  } catch (Error const&) {
    return bytes.size() * MemoryModel::per_image_byte;
  }
}

std::uint64_t image_memory(Resolve const& resolve, std::string const& name) {
  try {
    std::optional<Blob> const file = resolve(name);
    return file ? image_memory(file->bytes) : 0;
  } catch (Error const&) {
    return 0;  // leads out of the folder: the reader will not take it either
  }
}

Census census_of_ply(std::string_view file, Resolve const& resolve) {
  PlyHeader const header = parse_ply_header(file);
  Census census;
  for (PlyElement const& element : header.elements) {
    if (element.name == "face") census.triangles += std::min<std::uint64_t>(element.count, file.size() / kPlyBytes);
    if (element.name == "tristrips") census.triangles += file.size() / kPlyBytes;
  }
  for (std::string const& texture : header.textures) census.image_memory += image_memory(resolve, texture);
  if (header.textures.empty()) census.per_thinned = MemoryModel::per_thinned;
  return census;
}

Census census_of_off(std::string_view file) {
  TextScanner scanner(file.substr(0, 4096), "OFF", 0, '#');
  scanner.next_line();
  std::span<std::string_view const> words = scanner.words();
  if (!words.empty() && words[0].ends_with("OFF")) words = words.subspan(1);  // the counts may share its line
  if (words.empty() && scanner.next_line()) words = scanner.words();
  std::int64_t const faces = words.size() > 1 ? scanner.integer(words[1]) : 0;
  return {std::min(static_cast<std::uint64_t>(std::max<std::int64_t>(faces, 0)), file.size() / kOffBytes), 0};
}

Census census_of_stl(std::string_view file) {
  if (file.size() < 84) return {};
  std::uint32_t count = 0;
  std::memcpy(&count, file.data() + 80, sizeof count);
  bool const text = file.starts_with("solid") && 84 + kStlBytes * count != file.size();
  return {text ? file.size() / kAsciiStlBytes : std::min<std::uint64_t>(count, file.size() / kStlBytes), 0,
          MemoryModel::per_thinned + MemoryModel::per_split};
}

/// Triangles of the `f` lines that end in a piece of an OBJ file.
std::uint64_t obj_triangles(std::string_view piece) {
  std::uint64_t triangles = 0;
  for (std::size_t at = piece.find("\nf "); at != std::string_view::npos; at = piece.find("\nf ", at + 1)) {
    std::string_view const line = piece.substr(at + 2, std::min(piece.find('\n', at + 2), piece.size()) - at - 2);
    std::uint64_t corners = 0;
    for (std::size_t i = 1; i < line.size(); ++i) corners += line[i - 1] == ' ' && line[i] > ' ';
    triangles += corners > 2 ? corners - 2 : 0;
  }
  return triangles;
}

/// Counted in pieces spread over the file: vertices and faces take turns in some files and not in others.
std::uint64_t sampled_obj_triangles(std::string_view file) {
  constexpr std::size_t pieces = 64, size = 4096;
  if (file.size() <= pieces * size) return obj_triangles(file);
  std::uint64_t found = 0;
  for (std::size_t i = 0; i < pieces; ++i)
    found += obj_triangles(file.substr((file.size() - size) / (pieces - 1) * i, size));
  return found == 0 ? file.size() / kObjBytes
                    : static_cast<std::uint64_t>(static_cast<double>(found) / (pieces * size) *
                                                 static_cast<double>(file.size()));
}

Census census_of_obj(std::string_view file, Resolve const& resolve) {
  Census census{sampled_obj_triangles(file), 0};
  std::set<std::string> images;
  TextScanner scanner(file.substr(0, 1 << 16), "OBJ");
  while (scanner.next_line()) {
    if (scanner.word() != "mtllib") continue;
    std::optional<Blob> const library = resolve(scanner.rest_of_line());
    std::vector<std::string> notes;
    for (MtlMaterial const& material : library ? parse_mtl(text(*library), notes) : std::vector<MtlMaterial>())
      images.insert({material.colour_map.file, material.normal_map.file});
  }
  images.erase("");
  for (std::string const& image : images) census.image_memory += image_memory(resolve, image);
  return census;
}

/// Elements of an accessor; none when the primitive has no such number.
std::uint64_t elements(GltfFile const& gltf, GltfJson const& object, char const* key) {
  std::optional<std::uint64_t> const accessor = whole(object, key);
  return accessor ? required(gltf.item("accessors", *accessor), "count") : 0;
}

std::uint64_t mesh_triangles(GltfFile const& gltf, GltfJson const& mesh) {
  std::uint64_t triangles = 0;
  for (GltfJson const& primitive : list(mesh, "primitives")) {
    std::uint64_t corners = elements(gltf, primitive, "indices");
    GltfJson const* const attributes = member(primitive, "attributes");
    if (corners == 0 && attributes) corners = elements(gltf, *attributes, "POSITION");
    triangles += whole(primitive, "mode").value_or(4) == 4 ? corners / 3 : corners;
  }
  return triangles;
}

/// What nodes and meshes announce, each mesh as often as nodes use it.
Census census_of_gltf(Blob const& blob, Resolve const& resolve) {
  constexpr std::size_t quickly_parsed = 64'000'000;
  bool const binary = text(blob).starts_with("glTF");
  if (!binary && blob.bytes.size() > quickly_parsed) return {blob.bytes.size() / kGltfBytes, 0};
  ReadLimits const limits;
  GltfFile gltf(blob, resolve, limits);
  Census census;
  for (GltfJson const& node : list(gltf.root(), "nodes"))
    if (std::optional<std::uint64_t> const mesh = whole(node, "mesh"))
      census.triangles += mesh_triangles(gltf, gltf.item("meshes", *mesh));
  for (GltfJson const& image : list(gltf.root(), "images")) {
    std::string const uri = string(image, "uri");
    if (uri.empty())
      census.image_memory += image_memory(gltf.view(required(image, "bufferView")).bytes);
    else
      census.image_memory +=
          uri.starts_with("data:") ? uri.size() * MemoryModel::per_image_byte : image_memory(resolve, uri);
  }
  return census;
}

Census census_of(ArchiveEntry const& entry) {
  std::string ending = entry.file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  Blob const blob = map_file(entry.file);
  Resolve const resolve = resolve_in(entry.file.parent_path());
  if (ending == ".ply") return census_of_ply(text(blob), resolve);
  if (ending == ".obj") return census_of_obj(text(blob), resolve);
  if (ending == ".stl") return census_of_stl(characters(blob.bytes));
  if (ending == ".off") return census_of_off(text(blob));
  return census_of_gltf(blob, resolve);
}

}  // namespace

Estimate estimate(ArchiveEntry const& entry) {
  Census census;
  try {
    census = census_of(entry);
  } catch (std::exception const&) {
    census = {entry.bytes / kGltfBytes, 0};  // damaged: reading it will say how
  }
  return {census.triangles, MemoryModel::base + census.triangles * MemoryModel::per_triangle + census.image_memory,
          census.per_thinned > 0 ? MemoryModel::thinned_base + census.triangles * census.per_thinned : 0};
}

}  // namespace vitrine::io
