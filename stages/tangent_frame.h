// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The frame in which clients read a tangent-space normal map.
/// glTF asks for MikkTSpace when TANGENT is absent; three.js, model-viewer and Babylon build it per pixel from screen
/// derivatives of position and uv instead. For a triangle that is constant up to the interpolated normal, and can be inverted.

#include "stages/data.h"

namespace vitrine {

/// Columns T, B (neither unit nor orthogonal: scaled by the longer one, as the clients do) and the unit normal N.
struct TangentFrame {
  V3f tangent, bitangent, normal;
};

/// Frame at a point of a triangle with the given corner positions, uvs and interpolated unit normal.
/// A triangle without uv area gets T = B = 0: only N counts there, as on the client.
TangentFrame client_frame(std::array<V3f, 3> const& positions, CornerUvs const& uvs, V3f const& normal);

/// Normal-map value m (each in [-1,1], unit, as stored: green up as glTF says) for which the client shows `wanted`
/// (unit, model space). Where the frame is singular, or `wanted` lies behind the normal, the nearest that it can show.
V3f to_tangent_space(TangentFrame const& frame, V3f const& wanted);

/// What the client shows for m: normalize(T m.x + B m.y + N m.z).
V3f from_tangent_space(TangentFrame const& frame, V3f const& m);

}  // namespace vitrine
