// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The statements of a Wavefront OBJ file. Internal to io.

#include "io/first_use.h"
#include "io/read_model.h"

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace vitrine::io {

/// What a corner of a face names: a row of v, and rows of vt and vn or `none`.
struct ObjCorner {
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t v = 0, vt = none, vn = none;
  bool operator==(ObjCorner const&) const = default;
};

struct ObjFile {
  std::vector<V3d> v;
  std::vector<Rgba16> colours;                   ///< as many as v, or empty
  std::vector<V2f> vt;                           ///< v runs down as in glTF; finite
  std::vector<V3f> vn;                           ///< unit, or zero
  FirstUse<ObjCorner> corners;                   ///< distinct, in the order of first use
  std::vector<Triangle> triangles;               ///< polygons as fans about their first corner; numbers of corners
  std::vector<std::uint16_t> face_materials;     ///< per triangle, index into material_names
  std::vector<std::string> material_names;       ///< in the order of first use
  std::vector<std::string> libraries;            ///< what follows each mtllib
  std::uint64_t short_faces = 0;                 ///< of fewer than three corners, left out
  std::uint64_t lost_uvs = 0, lost_normals = 0;  ///< corners that name a vt or vn that is not there
};

/// Errors: InvalidInput for what is no number and for a face that names no vertex, with the line; LimitExceeded.
ObjFile parse_obj(std::string_view text, ReadLimits const& limits);

}  // namespace vitrine::io
