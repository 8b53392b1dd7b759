// SPDX-License-Identifier: Apache-2.0
#include "io/read_model.h"

#include "io/stand_in.h"

#include <algorithm>
#include <array>
#include <string>

namespace vitrine::io {

std::span<Format const> formats() {
  static constexpr std::array<Format, 6> table{{{".ply", read_ply},
                                                {".obj", read_obj},
                                                {".stl", read_stl},
                                                {".off", read_off},
                                                {".glb", read_gltf},
                                                {".gltf", read_gltf}}};
  return table;
}

SourceModel read_model(std::string_view ending, Blob const& file, Resolve const& resolve, ReadOptions const& options) {
  std::span<Format const> const known = formats();
  auto const format = std::find_if(known.begin(), known.end(), [&](Format const& f) { return f.ending == ending; });
  if (format != known.end()) {
    refuse_stand_in(file.bytes, "file");
    return format->read(file, resolve, options);
  }
  std::string names;
  for (Format const& f : known) names += (names.empty() ? "" : ", ") + std::string(f.ending);
  throw Error(ErrorKind::unsupported, "\"" + std::string(ending) + "\" is no known format",
              "convert the model to one of " + names);
}

void turn_z_up(SourceModel& model) {
  auto turn = [](auto& v) { v = {v.x, v.z, -v.y}; };
  for (V3f& p : model.mesh.positions) turn(p);
  for (V3f& n : model.normals) turn(n);
  for (V4f& t : model.tangents) t = {t.x, t.z, -t.y, t.w};
  turn(model.origin);
}

}  // namespace vitrine::io
