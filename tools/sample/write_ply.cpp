// SPDX-License-Identifier: Apache-2.0
#include "tools/sample/stream.h"
#include "tools/sample/write.h"

#include <bit>
#include <numeric>

namespace vitrine::sample {
namespace {

/// A seeded permutation (Fisher and Yates); the identity without a seed is an empty vector.
std::vector<std::uint32_t> permutation(std::size_t n, std::uint32_t seed) {
  std::vector<std::uint32_t> order(n);
  std::iota(order.begin(), order.end(), 0u);
  for (std::size_t i = n; i > 1; --i) {
    std::uint64_t const draw = std::uint64_t(hash(std::uint32_t(i), 1, 0, seed)) * i >> 32;
    std::swap(order[i - 1], order[draw]);
  }
  return order;
}

/// Which vertex and face stand where in the file.
struct Order {
  std::vector<std::uint32_t> vertex_at, place_of_vertex, face_at;  // all empty: as made

  Order(Scan const& scan, std::optional<std::uint32_t> seed) {
    if (!seed) return;
    vertex_at = permutation(scan.positions.size(), *seed);
    face_at = permutation(scan.triangles, *seed + 1);
    place_of_vertex.resize(vertex_at.size());
    for (std::size_t i = 0; i < vertex_at.size(); ++i) place_of_vertex[vertex_at[i]] = std::uint32_t(i);
  }
  std::size_t vertex(std::size_t i) const { return vertex_at.empty() ? i : vertex_at[i]; }
  Triangle face(Scan const& scan, std::size_t i) const {
    Triangle corners = triangle(scan, face_at.empty() ? i : face_at[i]);
    if (!place_of_vertex.empty())
      for (std::uint32_t& corner : corners) corner = place_of_vertex[corner];
    return corners;
  }
};

std::string header(Scan const& scan, Format encoding, bool coloured) {
  std::string_view const name = encoding == Format::ply_ascii    ? "ascii"
                                : encoding == Format::ply_little ? "binary_little_endian"
                                                                 : "binary_big_endian";
  std::string text =
      "ply\nformat " + std::string(name) + " 1.0\ncomment made by vitrine-sample, lengths in millimetres\n";
  text += "element vertex " + std::to_string(scan.positions.size()) +
          "\nproperty float x\nproperty float y\nproperty float z\n";
  if (coloured) text += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  text += "element face " + std::to_string(scan.triangles) + "\nproperty list uchar int vertex_indices\nend_header\n";
  return text;
}

template <bool Swap>
char* put_word(char* where, std::uint32_t word) {
  return put(where, Swap ? __builtin_bswap32(word) : word);
}

template <bool Swap>
void write_binary(std::ofstream& file, Scan const& scan, Order const& order, bool coloured) {
  write_records(file, scan.positions.size(), coloured ? 15 : 12, [&](std::size_t i, char* where) {
    std::size_t const vertex = order.vertex(i);
    for (int axis = 0; axis < 3; ++axis)
      where = put_word<Swap>(where, std::bit_cast<std::uint32_t>(scan.positions[vertex][axis]));
    if (coloured) put(where, scan.colours[vertex]);
  });
  write_records(file, scan.triangles, 13, [&](std::size_t i, char* where) {
    where = put(where, std::uint8_t{3});
    for (std::uint32_t const corner : order.face(scan, i)) where = put_word<Swap>(where, corner);
  });
}

void write_ascii(std::ofstream& file, Scan const& scan, Order const& order, bool coloured) {
  write_lines(file, scan.positions.size(), [&](std::size_t i, std::string& text) {
    std::size_t const vertex = order.vertex(i);
    for (int axis = 0; axis < 3; ++axis) print(text, scan.positions[vertex][axis]);
    if (coloured)
      for (std::uint8_t const channel : scan.colours[vertex]) print(text, channel);
    text += '\n';
  });
  write_lines(file, scan.triangles, [&](std::size_t i, std::string& text) {
    text += '3';
    for (std::uint32_t const corner : order.face(scan, i)) print(text, corner);
    text += '\n';
  });
}

}  // namespace

void write_ply(std::filesystem::path const& path, Scan const& scan, Format encoding, bool coloured,
               std::optional<std::uint32_t> shuffle) {
  static_assert(std::endian::native == std::endian::little);
  Order const order(scan, shuffle);
  std::ofstream file = create(path);
  file << header(scan, encoding, coloured);
  if (encoding == Format::ply_ascii)
    write_ascii(file, scan, order, coloured);
  else if (encoding == Format::ply_little)
    write_binary<false>(file, scan, order, coloured);
  else
    write_binary<true>(file, scan, order, coloured);
}

}  // namespace vitrine::sample
