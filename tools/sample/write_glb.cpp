// SPDX-License-Identifier: Apache-2.0
#include "io/image_codec.h"
#include "stages/error.h"
#include "tools/sample/stream.h"
#include "tools/sample/write.h"

#include <nlohmann/json.hpp>

#include <limits>

namespace vitrine::sample {
namespace {

using nlohmann::json;

constexpr int kFloat = 5126, kUint16 = 5123, kUint32 = 5125;

std::uint64_t padded(std::uint64_t bytes) { return (bytes + 3) / 4 * 4; }

/// Grows the lists of buffer views and accessors; each view follows the one before.
struct Layout {
  json views = json::array(), accessors = json::array();
  std::uint64_t bytes = 0;

  std::size_t view(std::uint64_t length) {
    views.push_back({{"buffer", 0}, {"byteOffset", bytes}, {"byteLength", length}});
    bytes += padded(length);
    return views.size() - 1;
  }
  std::size_t accessor(std::uint64_t count, std::uint64_t stride, int component, char const* type, int target) {
    std::size_t const index = view(count * stride);
    views[index]["target"] = target;
    accessors.push_back({{"bufferView", index}, {"componentType", component}, {"count", count}, {"type", type}});
    return accessors.size() - 1;
  }
};

json corner(V3f const& p) { return {p.x, p.y, p.z}; }

/// glTF's vertex colours are linear.
std::array<std::uint16_t, 4> linear(std::array<std::uint8_t, 3> const& colour) {
  auto const decode = [](std::uint8_t byte) {
    double const s = byte / 255.0;
    return std::uint16_t(65535 * (s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4)) + 0.5);
  };
  return {decode(colour[0]), decode(colour[1]), decode(colour[2]), 65535};
}

void write_word(std::ofstream& file, std::uint64_t word) {
  auto const value = std::uint32_t(word);
  file.write(reinterpret_cast<char const*>(&value), sizeof value);
}

}  // namespace

void write_glb(std::filesystem::path const& path, Scan const& scan, Colour colour) {
  bool const textured = colour == Colour::jpeg || colour == Colour::png, painted = colour == Colour::vertices;
  io::EncodedImage const image = textured ? encode_texture(scan, colour) : io::EncodedImage{};
  std::size_t const vertices = textured ? scan.split_vertices : scan.positions.size();
  auto const welded = [&](std::size_t i) { return textured ? split_vertex(scan, std::uint32_t(i)).vertex : i; };

  Layout layout;
  constexpr int kArrayBuffer = 34962, kElementBuffer = 34963;
  json attributes = {{"POSITION", layout.accessor(vertices, 12, kFloat, "VEC3", kArrayBuffer)}};
  Box3f box;
  for (V3f const& p : scan.positions) box.extendBy(p);
  layout.accessors[0]["min"] = corner(box.min);
  layout.accessors[0]["max"] = corner(box.max);
  if (textured) attributes["TEXCOORD_0"] = layout.accessor(vertices, 8, kFloat, "VEC2", kArrayBuffer);
  if (painted) {
    attributes["COLOR_0"] = layout.accessor(vertices, 8, kUint16, "VEC4", kArrayBuffer);
    layout.accessors[1]["normalized"] = true;
  }
  std::size_t const indices = layout.accessor(3 * scan.triangles, 4, kUint32, "SCALAR", kElementBuffer);
  json surface = {{"metallicFactor", 0}, {"roughnessFactor", 1}};
  json const primitive = {{"attributes", attributes}, {"indices", indices}, {"material", 0}};
  json document;
  document["asset"] = {{"version", "2.0"}, {"generator", "vitrine-sample"}};
  document["scene"] = 0;
  document["scenes"][0]["nodes"][0] = 0;
  document["nodes"][0]["mesh"] = 0;
  document["meshes"][0]["primitives"][0] = primitive;
  if (textured) {
    document["images"][0] = {{"bufferView", layout.view(image.bytes.size())}, {"mimeType", image.mime}};
    document["textures"][0]["source"] = 0;
    surface["baseColorTexture"]["index"] = 0;
  }
  document["materials"][0]["pbrMetallicRoughness"] = surface;
  document["bufferViews"] = layout.views;
  document["accessors"] = layout.accessors;
  document["buffers"][0]["byteLength"] = layout.bytes;

  std::string text = document.dump();
  text.resize(padded(text.size()), ' ');
  std::uint64_t const total = 12 + 8 + text.size() + 8 + layout.bytes;
  if (total > std::numeric_limits<std::uint32_t>::max())
    throw Error(ErrorKind::limit_exceeded, "a GLB of " + std::to_string(total) + " bytes is beyond its limit of 4 GiB",
                "ask for fewer triangles");
  std::ofstream file = create(path);
  for (std::uint64_t const word : {0x46546C67ul, 2ul, total, text.size(), 0x4E4F534Aul}) write_word(file, word);
  file << text;
  write_word(file, layout.bytes);
  write_word(file, 0x004E4942);
  write_records(file, vertices, 12, [&](std::size_t i, char* where) { put(where, scan.positions[welded(i)]); });
  if (textured)
    write_records(file, vertices, 8,
                  [&](std::size_t i, char* where) { put(where, split_vertex(scan, std::uint32_t(i)).uv); });
  if (painted)
    write_records(file, vertices, 8, [&](std::size_t i, char* where) { put(where, linear(scan.colours[i])); });
  write_records(file, scan.triangles, 12, [&](std::size_t i, char* where) {
    put(where, textured ? split_triangle(scan, i) : triangle(scan, i));
  });
  std::string tail(reinterpret_cast<char const*>(image.bytes.data()), image.bytes.size());
  tail.resize(padded(tail.size()));
  file << tail;
}

}  // namespace vitrine::sample
