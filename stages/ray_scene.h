// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Ray tracing over a triangle mesh (Embree), for baking, occlusion and rendering.

#include "stages/data.h"

#include <array>
#include <limits>
#include <memory>
#include <optional>

namespace vitrine {

/// Point on a surface: face and barycentric weights of its second and third corner.
struct Hit {
  std::uint32_t face = 0;
  float u = 0, v = 0;
  float distance = 0;  ///< along the ray, in lengths of its direction; or from the query point, in model units
};

struct Ray {
  V3f origin, direction;
  float near = 0, far = std::numeric_limits<float>::infinity();  ///< in lengths of the direction
  V3f side{0, 0, 0};  ///< if not zero, faces whose normal makes no acute angle with it let the ray pass
};

/// Immutable after construction; queries may come from any thread, and the first one makes the tree. Equal queries give
/// equal answers at any thread count, also where rays meet edges, vertices or faces that coincide: Embree puts what its
/// threads have parted back into order. The instruction set is pinned to AVX2, so that machines agree. The mesh must
/// outlive the scene.
///
/// Errors: LimitExceeded, by the first query, when memory does not suffice; Unsupported without AVX2.
class RayScene {
 public:
  static constexpr std::size_t kPacket = 64;

  explicit RayScene(TriMesh const& mesh);
  ~RayScene();
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;

  std::optional<Hit> first_hit(Ray const& ray) const;
  /// The same for coherent rays, about 2.5 times as fast per ray; a ray with far < near meets nothing.
  std::array<std::optional<Hit>, kPacket> first_hits(std::array<Ray, kPacket> const& rays) const;
  /// Whether anything lies between near and far; `side` does not count.
  bool occluded(Ray const& ray) const;
  /// Closest point nearer than `radius` on a face whose normal makes an acute angle with `side`; `side` zero: any face.
  std::optional<Hit> closest_point(V3f const& point, float radius, V3f const& side) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vitrine
