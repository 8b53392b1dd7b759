// SPDX-License-Identifier: Apache-2.0
#include "stages/ray_scene.h"

#include "stages/closest_point.h"
#include "stages/error.h"
#include "stages/parallel.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cstring>
#include <mutex>
#include <string>
#include <utility>

namespace vitrine {
namespace {

/// From this many faces on, memory counts for more than a third more time per ray.
constexpr std::size_t kCompactFaces = std::size_t{1} << 22;

void require(RTCError code) {
  if (code == RTC_ERROR_NONE) return;
  if (code == RTC_ERROR_OUT_OF_MEMORY)
    throw Error(ErrorKind::limit_exceeded, "no memory left for the ray-tracing tree", "give the program more memory");
  if (code == RTC_ERROR_UNSUPPORTED_CPU)
    throw Error(ErrorKind::unsupported, "the processor has no AVX2", "run on a processor with AVX2");
  throw Error(ErrorKind::broken, "embree reports error " + std::to_string(int(code)), "report this as a bug");
}

/// The process's one device; lives until the end of the process, as scenes may outlive any static object.
RTCDevice device() {
  static RTCDevice const shared = [] {
    RTCDevice const made = rtcNewDevice("isa=avx2");
    if (!made) require(rtcGetDeviceError(nullptr));
    return made;
  }();
  return shared;
}

struct SidedContext : RTCIntersectContext {
  Ray const* rays;

  explicit SidedContext(Ray const* of) : rays(of) { rtcInitIntersectContext(this); }
};

bool has_side(Ray const& ray) { return ray.side != V3f(0); }

bool on_side(V3f const& side, V3f const& normal) { return side == V3f(0) || side.dot(normal) > 0; }

void pass_wrong_sides(RTCFilterFunctionNArguments const* args) {
  Ray const* const rays = static_cast<SidedContext const*>(args->context)->rays;
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    V3f const normal(RTCHitN_Ng_x(args->hit, args->N, i), RTCHitN_Ng_y(args->hit, args->N, i),
                     RTCHitN_Ng_z(args->hit, args->N, i));
    if (!on_side(rays[RTCRayN_id(args->ray, args->N, i)].side, normal)) args->valid[i] = 0;
  }
}

RTCRay embree_ray(Ray const& ray) {
  return {ray.origin.x,
          ray.origin.y,
          ray.origin.z,
          ray.near,
          ray.direction.x,
          ray.direction.y,
          ray.direction.z,
          0,
          ray.far,
          0xffffffffu,
          0,
          0};
}

struct ClosestPoint {
  TriMesh const& mesh;
  V3f point, side;
  Hit best;
};

bool try_face(RTCPointQueryFunctionArguments* args) {
  ClosestPoint& query = *static_cast<ClosestPoint*>(args->userPtr);
  Triangle const& face = query.mesh.triangles[args->primID];
  V3f const a = query.mesh.positions[face[0]];
  V3f const b = query.mesh.positions[face[1]] - a, c = query.mesh.positions[face[2]] - a, p = query.point - a;
  if (!on_side(query.side, b.cross(c))) return false;
  Barycentric const at = closest_on_triangle(p, b, c);
  float const distance = (p - b * at.u - c * at.v).length();
  if (!(distance < query.best.distance)) return false;
  query.best = {args->primID, at.u, at.v, distance};
  args->query->radius = distance;
  return true;
}

}  // namespace

struct RayScene::Impl {
  TriMesh const& mesh;

  explicit Impl(TriMesh const& of) : mesh(of) { device(); }

  /// The tree is made for the first query: pictures of opaque models need none.
  RTCScene scene() {
    std::call_once(once_, [this] { build(); });
    return owner_.get();
  }

 private:
  void build() {
    std::unique_ptr<RTCSceneTy, decltype(&rtcReleaseScene)> made{rtcNewScene(device()), rtcReleaseScene};
    rtcSetSceneFlags(made.get(),
                     static_cast<RTCSceneFlags>(
                         RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION |
                         (mesh.triangles.size() >= kCompactFaces ? RTC_SCENE_FLAG_COMPACT : RTC_SCENE_FLAG_NONE)));
    RTCGeometry const geometry = rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_TRIANGLE);
    // Embree reads 4 bytes past the last vertex: it gets a copy with room for that.
    void* const vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(V3f),
                                                   mesh.positions.size());
    if (vertices) std::memcpy(vertices, mesh.positions.data(), mesh.positions.size() * sizeof(V3f));
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.triangles.data(), 0,
                               sizeof(Triangle), mesh.triangles.size());
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(made.get(), geometry);
    rtcReleaseGeometry(geometry);
    if (vertices) isolated([&] { rtcCommitScene(made.get()); });
    require(rtcGetDeviceError(device()));
    owner_ = std::move(made);
  }

  std::once_flag once_;
  std::unique_ptr<RTCSceneTy, decltype(&rtcReleaseScene)> owner_{nullptr, rtcReleaseScene};
};

RayScene::RayScene(TriMesh const& mesh) : impl_(std::make_unique<Impl>(mesh)) {}
RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

std::optional<Hit> RayScene::first_hit(Ray const& ray) const {
  SidedContext context(&ray);
  if (has_side(ray)) context.filter = pass_wrong_sides;
  RTCRayHit query{embree_ray(ray), {}};
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(impl_->scene(), &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return Hit{query.hit.primID, query.hit.u, query.hit.v, query.ray.tfar};
}

std::array<std::optional<Hit>, RayScene::kPacket> RayScene::first_hits(std::array<Ray, kPacket> const& rays) const {
  SidedContext context(rays.data());
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  if (std::any_of(rays.begin(), rays.end(), has_side)) context.filter = pass_wrong_sides;
  std::array<RTCRayHit8, kPacket / 8> queries;
  for (unsigned i = 0; i < kPacket; ++i) {
    Ray const& from = rays[i];
    RTCRay8& ray = queries[i / 8].ray;
    unsigned const k = i % 8;
    ray.org_x[k] = from.origin.x, ray.org_y[k] = from.origin.y, ray.org_z[k] = from.origin.z;
    ray.dir_x[k] = from.direction.x, ray.dir_y[k] = from.direction.y, ray.dir_z[k] = from.direction.z;
    ray.tnear[k] = from.near, ray.tfar[k] = from.far;
    ray.time[k] = 0, ray.mask[k] = 0xffffffffu, ray.id[k] = i, ray.flags[k] = 0;
    queries[i / 8].hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
  }
  rtcIntersectNM(impl_->scene(), &context, reinterpret_cast<RTCRayHitN*>(queries.data()), 8, kPacket / 8,
                 sizeof(RTCRayHit8));
  std::array<std::optional<Hit>, kPacket> hits;
  for (unsigned i = 0; i < kPacket; ++i) {
    RTCRayHit8 const& query = queries[i / 8];
    unsigned const k = i % 8;
    if (query.hit.geomID[k] != RTC_INVALID_GEOMETRY_ID)
      hits[i] = Hit{query.hit.primID[k], query.hit.u[k], query.hit.v[k], query.ray.tfar[k]};
  }
  return hits;
}

bool RayScene::occluded(Ray const& ray) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay query = embree_ray(ray);
  rtcOccluded1(impl_->scene(), &context, &query);
  return query.tfar < 0;
}

std::optional<Hit> RayScene::closest_point(V3f const& point, float radius, V3f const& side) const {
  ClosestPoint closest{impl_->mesh, point, side, {0, 0, 0, radius}};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  RTCPointQuery query{point.x, point.y, point.z, 0, radius};
  rtcPointQuery(impl_->scene(), &query, &context, try_face, &closest);
  if (!(closest.best.distance < radius)) return std::nullopt;
  return closest.best;
}

}  // namespace vitrine
