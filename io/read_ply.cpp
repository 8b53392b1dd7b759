// SPDX-License-Identifier: Apache-2.0
#include "io/assemble.h"
#include "io/bytes.h"
#include "io/colour.h"
#include "io/ply_body.h"
#include "io/ply_columns.h"
#include "io/ply_faces.h"
#include "io/read_model.h"
#include "io/textures.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace vitrine::io {
namespace {

/// The columns of the vertices, and where they go.
class VertexReader {
 public:
  VertexReader(PlyBody const& body, PlyElement const& element, SourceModel& model) : element_(element), model_(model) {
    auto const found = ply_columns<3>(element, {{{"x"}, {"y"}, {"z"}}});
    if (!found) throw body.error("vertices have no x, y and z");
    position_ = *found;
    normal_ = ply_columns<3>(element, {{{"nx"}, {"ny"}, {"nz"}}});
    colour_ = PlyColour::of(element);
    uv_ = ply_columns<2>(element, {{{"s", "u", "texture_u", "texture_s"}, {"t", "v", "texture_v", "texture_t"}}});
    bool const floats = std::all_of(position_.begin(), position_.end(),
                                    [&](std::size_t p) { return element.properties[p].type == PlyType::float32; });
    if (floats && body.format() != PlyFormat::ascii)
      model.mesh.positions.resize(element.count);
    else
      exact_.resize(element.count);
    if (normal_) model.normals.resize(element.count);
    if (colour_) model.colours.resize(element.count);
    if (uv_) model.uvs.resize(element.count);
  }

  /// `get(p)`: value of property p of vertex i.
  template <class Get>
  void put(std::uint64_t i, Get const& get) {
    V3d const p = triple(position_, get);
    if (exact_.empty())
      model_.mesh.positions[i] = V3f(p);
    else
      exact_[i] = p;
    if (normal_) model_.normals[i] = unit_or_zero(triple(*normal_, get));
    if (colour_) {
      std::optional<Rgba16> const rgba = colour_->linear(get);
      if (!rgba) bad_.at(i);
      model_.colours[i] = rgba.value_or(kWhite);
    }
    if (uv_) {
      V2f const uv(static_cast<float>(get((*uv_)[0])), static_cast<float>(1 - get((*uv_)[1])));
      if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) bad_.at(i);
      model_.uvs[i] = uv;
    }
  }

  void finish(PlyBody const& body) {
    if (std::optional<std::uint64_t> const i = bad_.index())
      throw body.error("vertex " + std::to_string(*i) + " has a colour or texture coordinate that is not finite");
    if (!exact_.empty()) place(model_, exact_);
    bool const all_zero =
        std::all_of(model_.normals.begin(), model_.normals.end(), [](V3f const& n) { return n == V3f(0, 0, 0); });
    if (all_zero && !model_.normals.empty()) {
      model_.normals.clear();
      model_.notes.push_back("the normals of the PLY file are all zero and were left out");
    }
  }

 private:
  template <class Get>
  static V3d triple(PlyColumns<3> const& columns, Get const& get) {
    return {get(columns[0]), get(columns[1]), get(columns[2])};
  }

  PlyElement const& element_;
  SourceModel& model_;
  PlyColumns<3> position_{};
  std::optional<PlyColumns<3>> normal_;
  std::optional<PlyColour> colour_;
  std::optional<PlyColumns<2>> uv_;
  std::vector<V3d> exact_;  ///< positions that floats may not hold
  FirstBad bad_;
};

void read_vertices(PlyBody& body, PlyElement const& element, SourceModel& model) {
  VertexReader reader(body, element, model);
  bool const fixed = std::none_of(element.properties.begin(), element.properties.end(),
                                  [](PlyProperty const& p) { return p.count_type.has_value(); });
  if (std::optional<PlyLayout> const layout = body.layout(element); layout && fixed) {
    std::vector<PlyLoad> loads;
    for (PlyProperty const& property : element.properties) loads.push_back(ply_load(property.type, body.format()));
    in_blocks(element.count, [&](std::uint64_t begin, std::uint64_t end) {
      for (std::uint64_t i = begin; i < end; ++i) {
        std::byte const* const record = body.data() + i * layout->stride;
        reader.put(i, [&](std::size_t p) { return loads[p](record + layout->offsets[p]); });
      }
    });
    body.skip_bytes(element.count * layout->stride);
  } else {
    PlyRow row;
    for (std::uint64_t i = 0; i < element.count; ++i) {
      body.read_row(element, i, row);
      reader.put(i, [&](std::size_t p) { return row.scalars[p]; });
    }
  }
  reader.finish(body);
}

PlyElement const* find(PlyHeader const& header, std::string_view name) {
  auto const it =
      std::find_if(header.elements.begin(), header.elements.end(), [&](PlyElement const& e) { return e.name == name; });
  return it == header.elements.end() ? nullptr : &*it;
}

/// Moves the triangles into the model and splits vertices where corners or faces have attributes of their own.
void take_faces(SourceModel& model, PlyFaces faces, ReadLimits const& limits) {
  std::size_t const triangles = faces.triangles.size();
  if (triangles == 0) throw no_faces("PLY", model.mesh.positions.size());
  model.mesh.triangles = std::move(faces.triangles);
  CornerAttributes& corners = faces.corners;
  bool const split = !corners.uvs.empty() || !corners.face_colours.empty();
  if (!split) return check_limits(limits, model.mesh.positions.size(), triangles, bytes_of(model));
  check_limits(limits, 3 * triangles, triangles, bytes_of(model) + 3 * triangles * kBytesPerVertex);
  if (!corners.uvs.empty()) corners.uvs.resize(triangles);  // strips have none
  if (!corners.face_colours.empty()) corners.face_colours.resize(triangles, kWhite);
  split_vertices(model, corners);
}

/// Gives the model the materials of its textures; faces that name none of them get a plain one.
void add_textures(SourceModel& model, PlyHeader const& header, std::vector<std::int64_t> const& numbers,
                  Resolve const& resolve, ReadLimits const& limits) {
  if (header.textures.empty() || model.uvs.empty()) return;
  constexpr std::size_t kMost = 4096;
  if (header.textures.size() > kMost)
    throw Error(ErrorKind::limit_exceeded,
                std::to_string(header.textures.size()) + " textures exceed the limit of " + std::to_string(kMost),
                "merge the model's textures");
  Textures images(model, limits);
  model.materials.clear();
  for (std::string const& name : header.textures) {
    Material material;
    material.name = name;
    material.colour_map.image = images.take(name, ColourSpace::srgb, [&] { return resolve(name); });
    material.coloured = material.colour_map.image >= 0;
    model.materials.push_back(std::move(material));
  }
  if (numbers.empty()) return;
  auto const plain = static_cast<std::int64_t>(header.textures.size());
  std::uint64_t untextured = 0;
  for (std::size_t f = 0; f < model.mesh.triangles.size(); ++f) {
    std::int64_t const number = f < numbers.size() ? numbers[f] : -1;
    bool const known = number >= 0 && number < plain;
    untextured += !known;
    model.face_materials.push_back(static_cast<std::uint16_t>(known ? number : plain));
  }
  if (untextured == 0) return;
  model.materials.push_back({});
  model.notes.push_back(std::to_string(untextured) + " triangles name none of the " + std::to_string(plain) +
                        " textures");
}

}  // namespace

SourceModel read_ply(Blob const& file, Resolve const& resolve, ReadOptions const& options) {
  PlyHeader const header = parse_ply_header(text(file));
  PlyBody body(header, file);
  PlyElement const* const vertices = find(header, "vertex");
  if (vertices == nullptr) throw body.error("file has no element vertex");
  check_limits(options.limits, vertices->count, 0, vertices->count * sizeof(V3f));

  SourceModel model;
  PlyFaces faces;
  PlyFaceWants const wants{.vertices = vertices->count,
                           .uvs = !header.textures.empty(),
                           .textures = header.textures.size() > 1,
                           .colours = !PlyColour::of(*vertices)};
  for (PlyElement const& element : header.elements) {
    body.enter(element);
    if (element.name == "vertex") {
      read_vertices(body, element, model);
    } else if (element.name == "face") {
      read_ply_faces(body, element, wants, options.limits, faces);
    } else if (element.name == "tristrips") {
      read_ply_strips(body, element, wants.vertices, faces);
    } else {
      body.skip(element);
      model.notes.push_back("PLY element " + shown(element.name) + " ignored");
    }
  }
  if (header.format != PlyFormat::ascii && body.bytes_left() > 0)
    model.notes.push_back(std::to_string(body.bytes_left()) + " bytes after the last element of the PLY file ignored");
  std::vector<std::int64_t> const numbers = std::move(faces.textures);
  take_faces(model, std::move(faces), options.limits);
  add_textures(model, header, numbers, resolve, options.limits);
  return model;
}

}  // namespace vitrine::io
