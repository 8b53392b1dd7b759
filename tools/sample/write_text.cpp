// SPDX-License-Identifier: Apache-2.0
// OBJ, OFF and STL.
#include "tools/sample/stream.h"
#include "tools/sample/write.h"

namespace vitrine::sample {
namespace {

void write_material(std::filesystem::path const& path, Scan const& scan, Colour colour) {
  bool const jpeg = colour == Colour::jpeg;
  std::filesystem::path const image = std::filesystem::path(path).replace_extension(jpeg ? ".jpg" : ".png");
  std::ofstream(create(std::filesystem::path(path).replace_extension(".mtl")))
      << "newmtl surface\nKa 0 0 0\nKd 1 1 1\nKs 0 0 0\nillum 1\nmap_Kd " << image.filename().string() << '\n';
  io::EncodedImage const encoded = encode_texture(scan, colour);
  create(image).write(reinterpret_cast<char const*>(encoded.bytes.data()), std::streamsize(encoded.bytes.size()));
}

}  // namespace

void write_obj(std::filesystem::path const& path, Scan const& scan, Colour colour) {
  bool const textured = colour == Colour::jpeg || colour == Colour::png;
  std::ofstream file = create(path);
  file << "# made by vitrine-sample, lengths in millimetres\n";
  if (textured) {
    write_material(path, scan, colour);
    file << "mtllib " << path.stem().string() << ".mtl\nusemtl surface\n";
  }
  write_lines(file, scan.positions.size(), [&](std::size_t i, std::string& text) {
    text += 'v';
    for (int axis = 0; axis < 3; ++axis) print(text, scan.positions[i][axis]);
    text += '\n';
  });
  write_lines(file, textured ? scan.split_vertices : 0, [&](std::size_t i, std::string& text) {
    V2f const uv = split_vertex(scan, std::uint32_t(i)).uv;
    text += "vt";
    print(text, uv.x);
    print(text, 1 - uv.y);
    text += '\n';
  });
  write_lines(file, scan.triangles, [&](std::size_t i, std::string& text) {
    Triangle const corners = triangle(scan, i), uvs = split_triangle(scan, i);
    text += 'f';
    for (int k = 0; k < 3; ++k) {
      print(text, corners[k] + 1);
      if (textured) {
        print(text, uvs[k] + 1);
        text[text.rfind(' ')] = '/';
      }
    }
    text += '\n';
  });
}

void write_off(std::filesystem::path const& path, Scan const& scan) {
  std::ofstream file = create(path);
  file << "OFF\n" << scan.positions.size() << ' ' << scan.triangles << " 0\n";
  write_lines(file, scan.positions.size(), [&](std::size_t i, std::string& text) {
    for (int axis = 0; axis < 3; ++axis) print(text, scan.positions[i][axis]);
    text += '\n';
  });
  write_lines(file, scan.triangles, [&](std::size_t i, std::string& text) {
    text += '3';
    for (std::uint32_t const corner : triangle(scan, i)) print(text, corner);
    text += '\n';
  });
}

void write_stl(std::filesystem::path const& path, Scan const& scan) {
  std::ofstream file = create(path);
  std::string heading = "made by vitrine-sample, lengths in millimetres";
  heading.resize(80, ' ');
  file << heading;
  auto const count = std::uint32_t(scan.triangles);
  file.write(reinterpret_cast<char const*>(&count), sizeof count);
  write_records(file, scan.triangles, 50, [&](std::size_t i, char* where) {
    Triangle const corners = triangle(scan, i);
    V3f const &a = scan.positions[corners[0]], &b = scan.positions[corners[1]], &c = scan.positions[corners[2]];
    for (V3f const& vector : {(b - a).cross(c - a).normalized(), a, b, c})
      for (int axis = 0; axis < 3; ++axis) where = put(where, vector[axis]);
    put(where, std::uint16_t{0});
  });
}

}  // namespace vitrine::sample
