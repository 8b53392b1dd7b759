// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The frame in which clients read a tangent-space normal map.
///
/// glTF asks for MikkTSpace when TANGENT is absent. three.js (r187: normalmap_pars_fragment, normal_fragment_begin and
/// _maps, GLTFLoader), and with it model-viewer, and Babylon build the frame per pixel instead. With N the interpolated
/// normal, normalised, (q0, q1) the screen derivatives of the position and (s0, s1), (t0, t1) those of u and v:
///
///     T = (q1 x N) s0 + (N x q0) s1      scale = 1 / sqrt(max(T.T, B.B)), or 0
///     B = (q1 x N) t0 + (N x q0) t1      shown = normalize(scale T m.x - scale B m.y + N m.z)
///
/// The minus is GLTFLoader's, which turns normalScale.y round where there is no TANGENT: v points down in glTF, green
/// up. Both sums are N x (q0 s1 - q1 s0), and uv is affine in position over a triangle, also in perspective; so any two
/// vectors that span the triangle, with its winding, give the same directions as screen derivatives: its edges do.
/// Hence T and B are constant in a triangle up to N. They lie in the plane of N, neither unit nor orthogonal: the
/// gradients of u and -v, scaled by the longer one. Mirrored uvs need no special case. Seen from behind, a double-sided
/// material turns N and then T and B round (faceDirection): the negated normal is shown. Drawn flat, without NORMAL, N
/// is the face's own normal.

#include "stages/data.h"

namespace vitrine {

/// Columns T and B as above, scaled, B pointing up (-v), and the unit normal N.
struct TangentFrame {
  V3f tangent, bitangent, normal;
};

/// Frame at a point of a triangle with the given corner positions, uvs and interpolated unit normal.
/// A triangle without uv gradient gets T = B = 0: only N counts there, as on the client.
TangentFrame client_frame(std::array<V3f, 3> const& positions, CornerUvs const& uvs, V3f const& normal);

/// Normal-map value m (each in [-1,1], unit, as stored: green up as glTF says) for which the client shows `wanted`
/// (unit, model space). m.z is at least 1/255 of the whole: where `wanted` lies behind the normal, the nearest that can
/// be shown; where T and B are collinear, what they can reach with the shortest m.
V3f to_tangent_space(TangentFrame const& frame, V3f const& wanted);

/// What the client shows for m: normalize(T m.x + B m.y + N m.z).
V3f from_tangent_space(TangentFrame const& frame, V3f const& m);

}  // namespace vitrine
