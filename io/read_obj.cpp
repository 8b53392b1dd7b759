// SPDX-License-Identifier: Apache-2.0
#include "io/assemble.h"
#include "io/obj_parser.h"
#include "io/read_model.h"
#include "io/read_mtl.h"
#include "io/stand_in.h"
#include "io/text_scanner.h"

#include <map>
#include <optional>
#include <set>
#include <utility>

namespace vitrine::io {
namespace {

void note_count(SourceModel& model, std::uint64_t count, std::string const& what) {
  if (count > 0) model.notes.push_back(std::to_string(count) + " " + what);
}

void note_losses(ObjFile const& obj, std::string_view text, SourceModel& model) {
  note_count(model, obj.short_faces, "faces of fewer than three corners left out");
  note_count(model, obj.lost_uvs, "corners name a texture coordinate that is not there");
  note_count(model, obj.lost_normals, "corners name a normal that is not there");
  if (!text.ends_with('\n') && !text.ends_with('\r'))
    model.notes.push_back("the file's last line has no end: perhaps it is cut off");
}

/// One vertex per distinct corner. A corner without a normal keeps a zero one, which `clean` replaces by the surface's.
void fill_vertices(ObjFile const& obj, SourceModel& model) {
  std::vector<ObjCorner> const& corners = obj.corners.keys();
  std::vector<V3d> positions(corners.size());
  bool any_uv = false, any_normal = false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    positions[i] = obj.v[corners[i].v];
    any_uv |= corners[i].vt != ObjCorner::none;
    any_normal |= corners[i].vn != ObjCorner::none;
  }
  place(model, positions);
  if (any_uv) model.uvs.assign(corners.size(), V2f(0, 0));
  if (any_normal) model.normals.assign(corners.size(), V3f(0, 0, 0));
  if (!obj.colours.empty()) model.colours.resize(corners.size());
  std::uint64_t without_normal = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    ObjCorner const& corner = corners[i];
    if (any_uv && corner.vt != ObjCorner::none) model.uvs[i] = obj.vt[corner.vt];
    if (any_normal && corner.vn != ObjCorner::none) model.normals[i] = obj.vn[corner.vn];
    if (!obj.colours.empty()) model.colours[i] = obj.colours[corner.v];
    without_normal += any_normal && corner.vn == ObjCorner::none;
  }
  note_count(model, without_normal, "vertices without a normal get a smooth one");
}

/// The materials of one `mtllib` line: one file whose name may hold spaces, else several files.
void read_library(std::string const& line, Resolve const& resolve, std::map<std::string, MtlMaterial>& materials,
                  SourceModel& model) {
  auto const read = [&](std::string const& name) {
    try {
      if (std::optional<Blob> const file = resolve(name)) {
        refuse_stand_in(file->bytes, "file");
        for (MtlMaterial& material : parse_mtl(text(*file), model.notes))
          materials.try_emplace(material.name, std::move(material));
        return true;
      }
    } catch (Error const& error) {
      model.notes.push_back("material library \"" + name + "\" left out: " + error.what());
      return true;
    }
    return false;
  };
  if (read(line)) return;
  TextScanner names(line, "OBJ");
  names.next_line();
  auto const words = names.words();
  for (std::string_view const name : words)
    if (words.size() == 1 || !read(std::string(name)))
      model.notes.push_back("material library \"" + std::string(name) + "\" missing");
}

void fill_materials(ObjFile const& obj, Resolve const& resolve, ReadOptions const& options, SourceModel& model) {
  std::map<std::string, MtlMaterial> known;  // the first of a name counts
  std::set<std::string> read;
  for (std::string const& library : obj.libraries)
    if (read.insert(library).second) read_library(library, resolve, known, model);
  Textures textures(model, options.limits);
  model.materials.clear();
  for (std::string const& name : obj.material_names) {
    auto const found = known.find(name);
    MtlMaterial source = found != known.end() ? found->second : MtlMaterial{name, {}, 1, {}, {}};
    if (model.uvs.empty()) source.colour_map = source.normal_map = {};  // nothing says where they lie
    model.materials.push_back(
        to_material(source, !model.colours.empty(), options.mtl_kd, textures, resolve, model.notes));
  }
}

}  // namespace

SourceModel read_obj(Blob const& file, Resolve const& resolve, ReadOptions const& options) {
  std::string_view const raw = text(file);
  ObjFile obj = parse_obj(raw, options.limits);
  if (obj.triangles.empty()) throw no_faces("OBJ", obj.v.size());
  SourceModel model;
  note_losses(obj, raw, model);
  fill_vertices(obj, model);
  fill_materials(obj, resolve, options, model);
  model.mesh.triangles = std::move(obj.triangles);
  if (model.materials.size() > 1) model.face_materials = std::move(obj.face_materials);
  return model;
}

}  // namespace vitrine::io
