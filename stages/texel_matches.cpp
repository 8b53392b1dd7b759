// SPDX-License-Identifier: Apache-2.0
#include "stages/texel_matches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace vitrine {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

}  // namespace

TexelMatcher::TexelMatcher(Atlas const& atlas, std::vector<V3f> const& normals, SurveyedModel const& original,
                           BakeOptions const& options, int per_side)
    : atlas_(atlas),
      mesh_(atlas.mesh),
      normals_(normals),
      scene_(original.scene),
      transfer_(options.transfer),
      reach_(float(options.reach) * bounds(mesh_).size().length()) {
  faces_.reserve(mesh_.triangles.size());
  for (std::uint32_t f = 0; f < mesh_.triangles.size(); ++f) faces_.push_back(measured(f, per_side));
}

std::vector<TexelMatch> TexelMatcher::matches(std::vector<SurfacePoint> const& samples) const {
  std::vector<TexelMatch> found;
  found.reserve(samples.size());
  if (transfer_ == Transfer::nearest) {
    for (SurfacePoint const& point : samples) found.push_back({nearest(position(point)), outwards(point)});
    return found;
  }
  for (std::span rest(samples); !rest.empty(); rest = rest.subspan(std::min(RayScene::kPacket, rest.size())))
    shoot(rest.first(std::min(RayScene::kPacket, rest.size())), found);
  return found;
}

/// Outwards and inwards: what is nearer.
void TexelMatcher::shoot(std::span<SurfacePoint const> packet, std::vector<TexelMatch>& found) const {
  std::array<Ray, RayScene::kPacket> rays;
  rays.fill({V3f(0), V3f(0, 1, 0), 1, 0});  // meets nothing
  for (std::size_t i = 0; i < packet.size(); ++i) {
    V3f const side = outwards(packet[i]);
    rays[i] = {position(packet[i]), side, 0, reach_, side};
  }
  auto const outer = scene_.first_hits(rays);
  for (std::size_t i = 0; i < packet.size(); ++i) {
    rays[i].direction = -rays[i].side;
    if (outer[i]) rays[i].far = outer[i]->distance;
  }
  auto const inner = scene_.first_hits(rays);
  for (std::size_t i = 0; i < packet.size(); ++i) {
    V3f const &place = rays[i].origin, &side = rays[i].side;
    if (inner[i] || outer[i])
      found.push_back({inner[i] ? *inner[i] : *outer[i], side});
    else if (auto const close = scene_.closest_point(place, reach_, side))
      found.push_back({*close, side, true});
    else
      found.push_back({nearest(place), side, true});
  }
}

Hit TexelMatcher::nearest(V3f const& place) const {
  return scene_.closest_point(place, kInfinity, {0, 0, 0}).value_or(Hit{});
}

V3f TexelMatcher::smooth_normal(SurfacePoint const& point) const {
  Triangle const& t = mesh_.triangles[point.face];
  V3f const normal = interpolate(normals_[t[0]], normals_[t[1]], normals_[t[2]], point.at);
  return normal.length2() > 0 ? normal.normalized() : faces_[point.face].normal;
}

/// The smooth normal, unless it lies behind the face, as on edges of more than two faces.
V3f TexelMatcher::outwards(SurfacePoint const& point) const {
  V3f const smooth = smooth_normal(point), flat = faces_[point.face].normal;
  return smooth.dot(flat) > 0 ? smooth : flat;
}

V3f TexelMatcher::position(SurfacePoint const& point) const {
  Triangle const& t = mesh_.triangles[point.face];
  return interpolate(mesh_.positions[t[0]], mesh_.positions[t[1]], mesh_.positions[t[2]], point.at);
}

TexelMatcher::Face TexelMatcher::measured(std::uint32_t face, int per_side) const {
  Triangle const& t = mesh_.triangles[face];
  V3f const corner = mesh_.positions[t[0]];
  V3f const across = (mesh_.positions[t[1]] - corner).cross(mesh_.positions[t[2]] - corner);
  CornerUvs const& uv = atlas_.corner_uvs[face];
  float const texels = std::abs((uv[1] - uv[0]).cross(uv[2] - uv[0])) * float(atlas_.width) * float(atlas_.height);
  return {across.normalized(), texels > 0 ? std::sqrt(across.length() / texels) / float(per_side) : 0};
}

}  // namespace vitrine
