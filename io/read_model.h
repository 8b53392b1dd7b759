// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Bytes to SourceModel.
///
/// | format   | kept                                                                                                 |
/// |----------|------------------------------------------------------------------------------------------------------|
/// | PLY      | ascii, little and big endian; faces or tristrips; normals, colours and uv of vertices, TextureFile;  |
/// |          | colours of faces, uv of corners                                                                      |
/// | OBJ+MTL  | polygons, negative indices, vertex colours, normals, uv; Kd, map_Kd, d, Tr, norm of several materials |
/// | STL      | ascii, binary; binary facet colours are not read                                                     |
/// | OFF      | [ST][C][N]OFF ascii; colours of vertices or faces, as bytes or 0..1                                  |
/// | glTF/GLB | rest pose of the default scene; Draco, meshopt, quantisation, texture transform, data URIs, COLOR_0, |
/// |          | emission and its strength                                                                            |
///
/// Hostile input is normal: counts are believed only as far as bytes are present, every index is checked here, before a
/// TriMesh exists. Positions may still be NaN or infinite: `clean` drops and counts those. Colours and uvs are finite.
/// Errors of all readers: InvalidInput, Unsupported, LimitExceeded; with the value, and where in the file.

#include "io/blob.h"
#include "stages/data.h"
#include "stages/error.h"

#include <cstdint>

namespace vitrine::io {

struct ReadLimits {
  std::uint64_t vertices = 1'500'000'000;
  std::uint64_t triangles = 1'500'000'000;
  std::uint64_t texels = 1ull << 30;  ///< of all images of a model together
  std::uint64_t bytes = 16ull << 30;  ///< what the arrays and images of one model may take
  int nesting = 64;                   ///< nodes below nodes
};

enum class MtlKd { ignore, multiply };  ///< what a Kd beside a map_Kd does

struct ReadOptions {
  ReadLimits limits;
  MtlKd mtl_kd = MtlKd::ignore;
  bool occlusion_maps = false;  ///< those of glTF: only a thumbnail that is measured with them needs them
};

SourceModel read_ply(Blob const& file, Resolve const& resolve, ReadOptions const& options = {});
SourceModel read_obj(Blob const& file, Resolve const& resolve, ReadOptions const& options = {});
SourceModel read_stl(Blob const& file, Resolve const& resolve, ReadOptions const& options = {});
SourceModel read_off(Blob const& file, Resolve const& resolve, ReadOptions const& options = {});
SourceModel read_gltf(Blob const& file, Resolve const& resolve, ReadOptions const& options = {});

/// The formats by file name ending (lower case, with the dot).
struct Format {
  std::string_view ending;
  SourceModel (*read)(Blob const&, Resolve const&, ReadOptions const&);
};
std::span<Format const> formats();

/// Reads by ending. Errors: Unsupported, naming the known endings.
SourceModel read_model(std::string_view ending, Blob const& file, Resolve const& resolve,
                       ReadOptions const& options = {});

/// Turns a z-up model to +Y up: (x, y, z) -> (x, z, -y), positions, normals and origin.
void turn_z_up(SourceModel& model);

}  // namespace vitrine::io
