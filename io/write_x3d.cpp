// SPDX-License-Identifier: Apache-2.0
#include "io/write_x3d.h"

#include "io/colour_map.h"
#include "io/mesh_codec.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>
#include <string>
#include <utility>

namespace vitrine::io {
namespace {

constexpr double kHalfAngle = std::numbers::pi / 12, kRise = std::numbers::pi / 18;  // as the measure's first view

/// Little-endian, as all browsers' machines are.
template <class Integer>
void append(std::vector<std::byte>& bytes, Integer value) {
  std::size_t const end = bytes.size();
  bytes.resize(end + sizeof value);
  std::memcpy(&bytes[end], &value, sizeof value);
}

std::uint16_t sixteen_bits(float share) {
  return static_cast<std::uint16_t>(std::lround(std::clamp(share, 0.f, 1.f) * 65535));
}

/// What a browser draws flat: every face with vertices and a normal of its own.
VertexMesh with_flat_normals(VertexMesh const& mesh) {
  VertexMesh flat;
  for (Triangle const& t : mesh.triangles) {
    V3f const p = mesh.positions[t[0]];
    V3f const normal = (mesh.positions[t[1]] - p).cross(mesh.positions[t[2]] - p).normalized();
    auto const first = static_cast<std::uint32_t>(flat.positions.size());
    for (std::uint32_t v : t) {
      flat.positions.push_back(mesh.positions[v]);
      flat.normals.push_back(normal);
      if (!mesh.uvs.empty()) flat.uvs.push_back(mesh.uvs[v]);
      if (!mesh.colours.empty()) flat.colours.push_back(mesh.colours[v]);
    }
    flat.triangles.push_back({first, first + 1, first + 2});
  }
  return flat;
}

VertexMesh drawn_mesh(BakedModel const& model) {
  BakedModel geometry;
  geometry.mesh = model.mesh;
  geometry.corner_uvs = model.corner_uvs;
  geometry.normals = model.normals;
  geometry.colours = model.colours;
  VertexMesh mesh = split_vertices(geometry);
  return mesh.normals.empty() ? with_flat_normals(mesh) : mesh;
}

std::vector<std::byte> coordinates(VertexMesh const& mesh, Grid const& grid) {
  std::vector<std::byte> bytes;
  for (V3f const& p : mesh.positions)
    for (unsigned k = 0; k < 3; ++k) append(bytes, sixteen_bits((p[k] - grid.origin[k]) / grid.range));
  return bytes;
}

/// X3D's v points up.
std::vector<std::byte> texture_coordinates(VertexMesh const& mesh) {
  std::vector<std::byte> bytes;
  for (V2f const& uv : mesh.uvs) {
    append(bytes, sixteen_bits(uv.x));
    append(bytes, static_cast<std::uint16_t>(65535 - sixteen_bits(uv.y)));
  }
  return bytes;
}

std::vector<std::byte> normals(VertexMesh const& mesh) {
  std::vector<std::byte> bytes;
  for (V3f const& n : mesh.normals)
    for (unsigned k = 0; k < 3; ++k)
      append(bytes, static_cast<std::int8_t>(std::lround(std::clamp(n[k], -1.f, 1.f) * 127)));
  return bytes;
}

/// Linear, as X3DOM takes them; there they replace the material's colour.
std::vector<std::byte> colours(VertexMesh const& mesh, Rgba const& factor) {
  std::vector<std::byte> bytes;
  for (V3f const& c : mesh.colours)
    for (unsigned k = 0; k < 3; ++k) append(bytes, sixteen_bits(c[k] * factor[k]));
  return bytes;
}

bool needs_32_bits(VertexMesh const& mesh) { return mesh.positions.size() > 65535; }

std::vector<std::byte> indices(VertexMesh const& mesh) {
  std::vector<std::byte> bytes;
  for (Triangle const& t : mesh.triangles)
    for (std::uint32_t v : t) needs_32_bits(mesh) ? append(bytes, v) : append(bytes, static_cast<std::uint16_t>(v));
  return bytes;
}

// ---- The page
// -------------------------------------------------------------------------------------------------------

/// The fewest digits that read back.
std::string text(double value) { return nlohmann::json(value).dump(); }
std::string text(float value) { return nlohmann::json(value).dump(); }
template <class Vector>
std::string list(Vector const& v) {
  return text(v[0]) + " " + text(v[1]) + " " + text(v[2]);
}

std::string escaped(std::string_view plain) {
  std::string html;
  for (char c : plain) {
    if (c == '&')
      html += "&amp;";
    else if (c == '<')
      html += "&lt;";
    else if (c == '>')
      html += "&gt;";
    else
      html += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return html;
}

/// ` name="value"`
std::string attribute(std::string_view name, std::string const& value) {
  return " " + std::string(name) + "=\"" + value + "\"";
}

/// From the front and slightly above, from where the object just fits.
std::string viewpoint(BakedModel const& model) {
  Box3f const box = bounds(model.mesh);
  float radius = 0;
  for (V3f const& p : model.mesh.positions) radius = std::max(radius, (p - box.center()).length());
  V3d const centre = model.origin + V3d(box.center());
  double const distance = double(radius) / std::sin(kHalfAngle);
  V3d const eye = centre + V3d(0, std::sin(kRise), std::cos(kRise)) * distance;
  return "<viewpoint" + attribute("position", list(eye)) + attribute("orientation", "1 0 0 " + text(-kRise)) +
         attribute("centerOfRotation", list(centre)) + attribute("fieldOfView", text(2 * kHalfAngle)) + "></viewpoint>";
}

std::string texture(std::string_view use, std::string const& url) {
  return "<imageTexture" + attribute("containerField", std::string(use)) + attribute("url", url) +
         attribute("repeatS", "false") + attribute("repeatT", "false") + "></imageTexture>";
}

struct Maps {
  std::string colour, normal;  ///< file names; empty: none
};

std::string appearance(BakedModel const& model, Maps const& maps) {
  V3f const diffuse(model.base_colour[0], model.base_colour[1], model.base_colour[2]);  // linear there, too
  // The bias turns X3DOM's green, which points down, to glTF's.
  return "<appearance><commonSurfaceShader" + attribute("diffuseFactor", list(diffuse)) +
         attribute("specularFactor", "0 0 0") + attribute("normalBias", "-1 1 1") + ">" +
         (maps.colour.empty() ? "" : texture("diffuseTexture", maps.colour)) +
         (maps.normal.empty() ? "" : texture("normalTexture", maps.normal)) + "</commonSurfaceShader></appearance>";
}

std::string geometry(BakedModel const& model, VertexMesh const& mesh) {
  Grid const& grid = model.grid;
  std::string const size = text(grid.range);
  return "<binaryGeometry" + attribute("position", list(grid.origin + V3f(grid.range / 2))) +
         attribute("size", size + " " + size + " " + size) +
         attribute("vertexCount", std::to_string(3 * mesh.triangles.size())) + attribute("primType", "'TRIANGLES'") +
         attribute("index", "index.bin") + attribute("indexType", needs_32_bits(mesh) ? "Uint32" : "Uint16") +
         attribute("coord", "coord.bin") + attribute("coordType", "Uint16") + attribute("normal", "normal.bin") +
         attribute("normalType", "Int8") +
         (mesh.colours.empty() ? "" : attribute("color", "colour.bin") + attribute("colorType", "Uint16")) +
         (mesh.uvs.empty() ? "" : attribute("texCoord", "texcoord.bin") + attribute("texCoordType", "Uint16")) +
         attribute("solid", model.double_sided ? "false" : "true") + attribute("lit", model.unlit ? "false" : "true") +
         "></binaryGeometry>";
}

std::string page(BakedModel const& model, VertexMesh const& mesh, Maps const& maps, std::string_view title) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>" + escaped(title) +
         "</title>\n<link rel=\"icon\" href=\"data:,\">\n<script src=\"" + std::string(kX3domScript) +
         "\"></script>\n<style>html, body { margin: 0; height: 100%; } "
         "x3d, .x3dom-canvas { display: block; width: 100%; height: 100%; border: 0; outline: 0; "
         "}</style>\n</head>\n<body>\n<x3d><scene>\n"
         "<environment gammaCorrectionDefault=\"linear\"></environment>\n<background skyColor=\"1 1 "
         "1\"></background>\n" +
         viewpoint(model) + "\n<transform" + attribute("translation", list(model.origin)) + "><shape>\n" +
         appearance(model, maps) + "\n" + geometry(model, mesh) +
         "\n</shape></transform>\n</scene></x3d>\n</body>\n</html>\n";
}

/// Adds the map's file; returns its name.
std::string add_map(std::vector<NamedFile>& files, std::string const& name, EncodedImage coded) {
  std::string const ending(coded.mime.substr(coded.mime.find('/') + 1));
  files.push_back({name + "." + (ending == "jpeg" ? "jpg" : ending), std::move(coded.bytes)});
  return files.back().name;
}

}  // namespace

std::vector<NamedFile> write_x3d(BakedModel const& model, std::string_view title, EncodeOptions const& options) {
  VertexMesh const mesh = drawn_mesh(model);
  std::vector<NamedFile> files(1);
  files.push_back({"index.bin", indices(mesh)});
  files.push_back({"coord.bin", coordinates(mesh, model.grid)});
  files.push_back({"normal.bin", normals(mesh)});
  if (!mesh.uvs.empty()) files.push_back({"texcoord.bin", texture_coordinates(mesh)});
  if (!mesh.colours.empty()) files.push_back({"colour.bin", colours(mesh, model.base_colour)});
  Maps maps;
  if (model.colour) maps.colour = add_map(files, "colour", code_colour(*model.colour, options).image);
  if (model.derived_normal) maps.normal = add_map(files, "normal", encode_normal(*model.derived_normal, options));
  std::string const html = page(model, mesh, maps, title);
  auto const* begin = reinterpret_cast<std::byte const*>(html.data());
  files[0] = {"index.html", {begin, begin + html.size()}};
  return files;
}

}  // namespace vitrine::io
