// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The frames in which clients read a tangent-space normal map.
///
/// With TANGENT, as in every file that we write, all clients agree: glTF says B = cross(N, T) w with the vertex's own
/// normal and tangent. three.js (r187: normal_vertex, normal_fragment_begin and _maps) normalises T and B at the
/// vertex, interpolates, normalises again, and shows normalize(T m.x + B m.y + N m.z); GLTFLoader leaves normalScale
/// alone. Our T is the same at all vertices of a chart, so that it costs next to nothing, and w is 1; hence T is hardly
/// ever orthogonal to N, and normal maps must be made for the skewed frame. Where T leans by some angle from the plane
/// of N, clients that leave B unnormalised (Babylon) shorten m.y by that angle's cosine.
///
/// Without TANGENT clients differ. glTF asks for MikkTSpace, the Khronos validator warns of it, but three.js
/// (normalmap_pars_fragment), and with it model-viewer, and Babylon build the frame per pixel, jumping from triangle to
/// triangle; originals are read as they show them. With N the interpolated normal, normalised, (q0, q1) the screen
/// derivatives of the position and (s0, s1), (t0, t1) those of u and v:
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
#include "stages/lanes.h"

namespace vitrine {

/// Columns T and B as above, of length 1 or scaled, and the unit normal N.
struct TangentFrame {
  V3f tangent, bitangent, normal;
};

/// Frame of a model without TANGENT, at a point of a triangle with the given corner positions, uvs and interpolated
/// unit normal; B points up (-v).
/// A triangle without uv gradient gets T = B = 0: only N counts there, as on the client.
TangentFrame client_frame(std::array<V3f, 3> const& positions, CornerUvs const& uvs, V3f const& normal);

/// Frame of a model with TANGENT of w = 1, where the interpolated unit normal and the tangent are these.
/// A tangent along the normal gives B = 0.
TangentFrame stored_frame(V3f const& normal, V3f const& tangent);

/// Normal-map value m (each in [-1,1], unit, as stored: green up as glTF says) for which the client shows `wanted`
/// (unit, model space). m.z is at least 1/255 of the whole: where `wanted` lies behind the plane of T and B, the
/// nearest that can be shown; where T and B are collinear, what they can reach with the shortest m.
V3f to_tangent_space(TangentFrame const& frame, V3f const& wanted);

/// What the client shows for m: normalize(T m.x + B m.y + N m.z).
V3f from_tangent_space(TangentFrame const& frame, V3f const& m);

/// The same side by side in stored frames: `tangents` as interpolated (xyz, and w the side of the bitangent), `n` unit.
/// 0 where a lane has no tangent.
LaneVector<3> in_stored_frames(LaneVector<4> const& tangents, LaneVector<3> const& n, LaneVector<3> const& m,
                               std::size_t count);

}  // namespace vitrine
