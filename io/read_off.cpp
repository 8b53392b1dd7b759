// SPDX-License-Identifier: Apache-2.0
#include "io/assemble.h"
#include "io/colour.h"
#include "io/read_model.h"
#include "io/text_scanner.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string>

namespace vitrine::io {
namespace {

using Words = std::span<std::string_view const>;

/// What the heading says: [ST][C][N]OFF, and the counts.
struct Heading {
  bool uvs = false, colours = false, normals = false;
  std::uint64_t vertices = 0, faces = 0;
};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool take_prefix(std::string_view& word, std::string_view prefix) {
  if (!word.starts_with(prefix)) return false;
  word.remove_prefix(prefix.size());
  return true;
}

/// A count is believed when so many lines of `shortest` bytes can follow.
std::uint64_t count(TextScanner const& lines, std::string_view word, std::string const& unit, std::uint64_t shortest) {
  std::int64_t const value = lines.integer(word);
  std::uint64_t const room = lines.bytes_left() / shortest + 1;
  if (value < 0 || std::uint64_t(value) > room)
    throw lines.error(std::to_string(value) + " " + unit + " announced, the file has room for " + std::to_string(room),
                      "copy or export the file again and compare its size");
  return std::uint64_t(value);
}

Heading read_heading(TextScanner& lines) {
  if (!lines.next_line()) throw lines.error("the file is empty", "copy or export the file again");
  Heading heading;
  std::string_view const first = lines.word();
  std::string_view word = first;
  heading.uvs = take_prefix(word, "ST");
  heading.colours = take_prefix(word, "C");
  heading.normals = take_prefix(word, "N");
  if (word == "4OFF" || word == "nOFF" || word == "4nOFF")
    throw Error(ErrorKind::unsupported, "points of four or more dimensions (" + shown(first) + ") are not read",
                "export the model with x, y and z alone");
  bool const known = take_prefix(word, "OFF") && std::all_of(word.begin(), word.end(), is_digit);
  if (!known) throw lines.error(shown(first) + " is no OFF heading", "check that the file is an OFF file");
  std::vector<std::string_view> counts;
  if (!word.empty()) counts.push_back(word);  // "OFF8 6 12", as whole collections have it
  auto const take_counts = [&] { std::ranges::copy(lines.words(), std::back_inserter(counts)); };
  take_counts();
  if (counts.empty()) {
    if (!lines.next_line()) throw lines.error("the counts are missing");
    take_counts();
  }
  if (counts[0] == "BINARY")
    throw Error(ErrorKind::unsupported, "binary OFF is not read", "export the model as text, or as PLY");
  if (counts.size() < 2) throw lines.error("the counts of vertices and faces are missing");
  heading.vertices = count(lines, counts[0], "vertices", sizeof "0 0 0");
  heading.faces = count(lines, counts[1], "faces", sizeof "0");
  return heading;
}

/// 3 or 4 words: bytes when all of them are whole numbers, else in [0,1]. Coverage is not kept: surfaces are opaque.
Rgba16 colour(TextScanner const& lines, Words words) {
  words = words.first(std::min<std::size_t>(words.size(), 4));
  bool const whole = std::all_of(words.begin(), words.end(),
                                 [](std::string_view word) { return std::all_of(word.begin(), word.end(), is_digit); });
  Rgba16 rgba{0, 0, 0, 65535};
  for (std::size_t k = 0; k < 3; ++k) {
    double const value = lines.number(words[k]);
    if (!std::isfinite(value)) throw lines.error("a colour is " + shown(words[k]));
    rgba[k] = linear16(value / (whole ? 255 : 1));
  }
  return rgba;
}

V3d triple(TextScanner const& lines, Words words) {
  return {lines.number(words[0]), lines.number(words[1]), lines.number(words[2])};
}

V2f texture_coordinate(TextScanner const& lines, Words words) {
  V2f const uv(float(lines.number(words[0])), float(1 - lines.number(words[1])));
  if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) throw lines.error("a texture coordinate is not finite");
  return uv;
}

/// Lines of: x y z [nx ny nz] [r g b [a]] [s t]. Colours also come under a plain heading.
void read_vertices(TextScanner& lines, Heading const& heading, SourceModel& model) {
  std::size_t const normal_words = heading.normals ? 3 : 0, uv_words = heading.uvs ? 2 : 0;
  std::vector<V3d> positions;
  positions.reserve(heading.vertices);
  bool coloured = heading.colours;
  for (std::uint64_t i = 0; i < heading.vertices; ++i) {
    lines.next_line_of("vertices", i, heading.vertices);
    Words const words = lines.words();
    std::size_t const fixed = 3 + normal_words + uv_words;
    if (words.size() < fixed)
      throw lines.error("a vertex has " + std::to_string(words.size()) + " of " + std::to_string(fixed) + " numbers");
    std::size_t const colour_words = words.size() - fixed;
    if (i == 0 && (colour_words == 3 || colour_words == 4)) coloured = true;
    positions.push_back(triple(lines, words));
    if (heading.normals) model.normals.push_back(unit_or_zero(triple(lines, words.subspan(3))));
    if (coloured)
      model.colours.push_back(colour_words < 3 ? kWhite : colour(lines, words.subspan(3 + normal_words, colour_words)));
    if (heading.uvs) model.uvs.push_back(texture_coordinate(lines, words.last(2)));
  }
  place(model, positions);
}

std::uint32_t vertex_index(TextScanner const& lines, std::string_view word, std::uint64_t vertices) {
  std::int64_t const index = lines.integer(word);
  if (index < 0 || std::uint64_t(index) >= vertices)
    throw lines.error("a face names vertex " + std::to_string(index) + " of " + std::to_string(vertices));
  return std::uint32_t(index);
}

void append_fan(TextScanner const& lines, Words polygon, std::uint64_t vertices, std::vector<Triangle>& triangles) {
  if (polygon.size() < 3) return;
  std::uint32_t const first = vertex_index(lines, polygon[0], vertices);
  std::uint32_t last = vertex_index(lines, polygon[1], vertices);
  for (std::string_view word : polygon.subspan(2)) {
    std::uint32_t const next = vertex_index(lines, word, vertices);
    triangles.push_back({first, last, next});
    last = next;
  }
}

/// Lines of: n i_1 … i_n [r g b [a]]. A single number after the corners points into a colour map, which nobody has.
CornerAttributes read_faces(TextScanner& lines, Heading const& heading, TriMesh& mesh) {
  CornerAttributes attributes;
  std::vector<Rgba16>& colours = attributes.face_colours;
  for (std::uint64_t i = 0; i < heading.faces; ++i) {
    lines.next_line_of("faces", i, heading.faces);
    Words const words = lines.words();
    std::int64_t const size = lines.integer(words[0]);
    if (size < 0 || std::uint64_t(size) >= words.size())
      throw lines.error("a face of " + std::to_string(size) + " corners has " + std::to_string(words.size() - 1) +
                        " numbers");
    Words const polygon = words.subspan(1, std::size_t(size)), rest = words.subspan(1 + polygon.size());
    if (rest.size() >= 3) colours.resize(mesh.triangles.size(), kWhite);
    bool const coloured = rest.size() >= 3 || !colours.empty();
    append_fan(lines, polygon, heading.vertices, mesh.triangles);
    if (coloured) colours.resize(mesh.triangles.size(), rest.size() >= 3 ? colour(lines, rest) : kWhite);
  }
  return attributes;
}

}  // namespace

SourceModel read_off(Blob const& file, Resolve const&, ReadOptions const& options) {
  TextScanner lines(text(file), "OFF", 0, '#');
  Heading const heading = read_heading(lines);
  check_limits(options.limits, heading.vertices, heading.faces, heading.vertices * kBytesPerVertex);
  SourceModel model;
  read_vertices(lines, heading, model);
  CornerAttributes const attributes = read_faces(lines, heading, model.mesh);
  std::uint64_t const triangles = model.mesh.triangles.size();
  if (triangles == 0) throw no_faces("OFF", heading.vertices);
  bool const split = !attributes.face_colours.empty() && model.colours.empty();
  std::uint64_t const vertices = split ? 3 * triangles : heading.vertices;
  check_limits(options.limits, vertices, triangles, vertices * kBytesPerVertex + triangles * sizeof(Triangle));
  if (split) split_vertices(model, attributes);
  return model;
}

}  // namespace vitrine::io
