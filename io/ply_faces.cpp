// SPDX-License-Identifier: Apache-2.0
#include "io/ply_faces.h"

#include "io/bytes.h"
#include "io/ply_columns.h"

#include <atomic>
#include <cmath>
#include <string>
#include <utility>

namespace vitrine::io {
namespace {

bool is_index(double value, std::uint64_t vertices) { return value >= 0 && value < double(vertices); }

Error index_error(PlyBody const& body, std::string const& where, double value, std::uint64_t vertices) {
  return body.error(where + " names vertex " + shown(value) + " of " + std::to_string(vertices));
}

std::size_t index_list(PlyBody const& body, PlyElement const& element) {
  std::optional<std::size_t> const list = element.list({"vertex_indices", "vertex_index"});
  if (!list) throw body.error("element " + shown(element.name) + " has no list vertex_indices");
  return *list;
}

/// The columns of a face element, and where its triangles go.
struct FaceReader {
  PlyElement const& element;
  std::uint64_t vertices;
  PlyFaces& faces;
  std::size_t indices;
  std::optional<std::size_t> uvs, texture;
  std::optional<PlyColour> colour;
  FirstBad bad;  ///< face with a bad index or a value that is not finite

  FaceReader(std::size_t list, PlyElement const& of, PlyFaceWants const& wants, PlyFaces& to)
      : element(of), vertices(wants.vertices), faces(to), indices(list) {
    if (wants.uvs) uvs = element.list({"texcoord"});
    if (wants.textures) texture = element.scalar({"texnumber"});
    if (wants.colours) colour = PlyColour::of(element);
  }

  /// Makes room for so many triangles.
  void resize(std::size_t triangles) {
    faces.triangles.resize(triangles);
    if (uvs) faces.corners.uvs.resize(triangles);
    if (colour) faces.corners.face_colours.resize(triangles, kWhite);
    if (texture) faces.textures.resize(triangles, -1);
  }

  /// Writes the face's fan from triangle `at` on.
  void put(PlyRow const& row, std::uint64_t face, std::size_t at) {
    std::vector<double> const& polygon = row.lists[indices];
    for (std::size_t k = 2; k < polygon.size(); ++k, ++at) {
      std::array const fan{std::size_t{0}, k - 1, k};
      for (std::size_t c = 0; c < 3; ++c) {
        double const index = polygon[fan[c]];
        if (is_index(index, vertices))
          faces.triangles[at][c] = static_cast<std::uint32_t>(index);
        else
          bad.at(face);
        if (uvs) faces.corners.uvs[at][c] = corner_uv(row.lists[*uvs], fan[c], face);
      }
      if (colour) faces.corners.face_colours[at] = face_colour(row, face);
      if (texture) faces.textures[at] = texture_number(row.scalars[*texture]);
    }
  }

  /// Throws what is wrong with this face.
  [[noreturn]] void explain(PlyBody const& body, PlyRow const& row, std::uint64_t face) const {
    std::string const where = "face " + std::to_string(face);
    for (double index : row.lists[indices])
      if (!is_index(index, vertices)) throw index_error(body, where, index, vertices);
    throw body.error(where + " has a colour or texture coordinate that is not finite");
  }

 private:
  V2f corner_uv(std::vector<double> const& list, std::size_t corner, std::uint64_t face) {
    if (2 * corner + 1 >= list.size()) return {0, 1};
    V2f const uv(float(list[2 * corner]), float(1 - list[2 * corner + 1]));
    if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) bad.at(face);
    return uv;
  }

  Rgba16 face_colour(PlyRow const& row, std::uint64_t face) {
    std::optional<Rgba16> const rgba = colour->linear([&](std::size_t p) { return row.scalars[p]; });
    if (!rgba) bad.at(face);
    return rgba.value_or(kWhite);
  }

  static std::int64_t texture_number(double value) {
    return value >= 0 && value < 65536 ? static_cast<std::int64_t>(value) : -1;
  }
};

/// Triangles of 32-bit indices and nothing else that is wanted: straight from the map. False when a record has another
/// size.
template <class Index, std::endian Order>
bool read_triangles(PlyBody const& body, PlyLayout const& layout, FaceReader& reader) {
  std::atomic<bool> uniform = true;
  in_blocks(reader.element.count, [&](std::uint64_t begin, std::uint64_t end) {
    for (std::uint64_t i = begin; i < end; ++i) {
      std::byte const* const record = body.data() + i * layout.stride;
      if (!layout.fits(record)) uniform = false;
      for (std::size_t k = 0; k < 3; ++k) {
        auto const index =
            static_cast<std::int64_t>(load<Index, Order>(record + layout.offsets[reader.indices] + 4 * k));
        if (index < 0 || std::uint64_t(index) >= reader.vertices) reader.bad.at(i);
        reader.faces.triangles[i][k] = static_cast<std::uint32_t>(index);
      }
    }
  });
  return uniform;
}

bool read_polygons(PlyBody const& body, PlyLayout const& layout, FaceReader& reader) {
  std::size_t const triangles = layout.list_sizes[reader.indices] - 2;
  std::atomic<bool> uniform = true;
  in_blocks(reader.element.count, [&](std::uint64_t begin, std::uint64_t end) {
    PlyRow row;
    for (std::uint64_t i = begin; i < end; ++i) {
      std::byte const* const record = body.data() + i * layout.stride;
      if (!layout.fits(record)) uniform = false;
      body.read_row(reader.element, layout, record, row);
      reader.put(row, i, i * triangles);
    }
  });
  return uniform;
}

bool read_records(PlyBody const& body, PlyLayout const& layout, FaceReader& reader) {
  PlyType const type = reader.element.properties[reader.indices].type;
  bool const big = body.format() == PlyFormat::big_endian;
  bool const corners_alone = !reader.uvs && !reader.texture && !reader.colour;
  if (layout.list_sizes[reader.indices] == 3 && corners_alone && type == PlyType::int32)
    return big ? read_triangles<std::int32_t, std::endian::big>(body, layout, reader)
               : read_triangles<std::int32_t, std::endian::little>(body, layout, reader);
  if (layout.list_sizes[reader.indices] == 3 && corners_alone && type == PlyType::uint32)
    return big ? read_triangles<std::uint32_t, std::endian::big>(body, layout, reader)
               : read_triangles<std::uint32_t, std::endian::little>(body, layout, reader);
  return read_polygons(body, layout, reader);
}

/// Reads faces whose records all have the layout, in parallel. False when they have not: `reader` then holds rubbish.
bool read_uniform(PlyBody& body, PlyLayout const& layout, ReadLimits const& limits, FaceReader& reader) {
  std::uint64_t const corners = layout.list_sizes[reader.indices];
  if (corners < 3) return false;
  std::uint64_t const triangles = reader.element.count * (corners - 2);
  check_limits(limits, 0, triangles, triangles * sizeof(Triangle));
  reader.resize(triangles);
  if (!read_records(body, layout, reader)) return false;
  if (std::optional<std::uint64_t> const face = reader.bad.index()) {
    PlyRow row;
    body.read_row(reader.element, layout, body.data() + *face * layout.stride, row);
    reader.explain(body, row, *face);
  }
  body.skip_bytes(reader.element.count * layout.stride);
  return true;
}

void read_one_by_one(PlyBody& body, ReadLimits const& limits, FaceReader& reader) {
  PlyRow row;
  for (std::uint64_t i = 0; i < reader.element.count; ++i) {
    body.read_row(reader.element, i, row);
    std::size_t const corners = row.lists[reader.indices].size(), before = reader.faces.triangles.size();
    if (corners < 3) continue;
    check_limits(limits, 0, before + corners - 2, (before + corners - 2) * sizeof(Triangle));
    reader.resize(before + corners - 2);
    reader.put(row, i, before);
    if (reader.bad.index()) reader.explain(body, row, i);
  }
}

/// Unrolls a list of strips. Every other triangle of a strip is wound the other way.
void append_strips(PlyBody const& body, std::vector<double> const& list, std::uint64_t vertices,
                   std::vector<Triangle>& triangles) {
  std::array<std::uint32_t, 2> last{};
  std::size_t length = 0;
  for (double const value : list) {
    if (value < 0) {
      length = 0;
      continue;
    }
    if (!is_index(value, vertices)) throw index_error(body, "a triangle strip", value, vertices);
    auto const index = static_cast<std::uint32_t>(value);
    if (length >= 2)
      triangles.push_back(length % 2 == 0 ? Triangle{last[0], last[1], index} : Triangle{last[1], last[0], index});
    last = {last[1], index};
    ++length;
  }
}

}  // namespace

void read_ply_faces(PlyBody& body, PlyElement const& element, PlyFaceWants const& wants, ReadLimits const& limits,
                    PlyFaces& faces) {
  std::size_t const indices = index_list(body, element);
  if (std::optional<PlyLayout> const layout = body.layout(element); layout && faces.triangles.empty()) {
    FaceReader reader(indices, element, wants, faces);
    if (read_uniform(body, *layout, limits, reader)) return;
    faces = {};
  }
  FaceReader reader(indices, element, wants, faces);
  read_one_by_one(body, limits, reader);
}

void read_ply_strips(PlyBody& body, PlyElement const& element, std::uint64_t vertices, PlyFaces& faces) {
  std::size_t const indices = index_list(body, element);
  PlyRow row;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    body.read_row(element, i, row);
    append_strips(body, row.lists[indices], vertices, faces.triangles);
  }
}

}  // namespace vitrine::io
