// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Ray tracing over a triangle mesh (Embree), for baking, occlusion and rendering.

#include "stages/data.h"

#include <memory>
#include <optional>

namespace vitrine {

/// Point on a surface: face and barycentric weights of its second and third corner; distance along the ray, or from the query point.
struct Hit {
  std::uint32_t face = 0;
  float u = 0, v = 0;
  float distance = 0;
};

/// Immutable after construction; queries may come from any thread. Equal queries give equal answers at any thread count:
/// the builder runs single-threaded in its content, the ISA is pinned, ties go to the lowest face.
/// The mesh must outlive the scene.
class RayScene {
 public:
  explicit RayScene(TriMesh const& mesh);
  ~RayScene();
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;

  /// First hit with distance in [near, far]. `accept(hit)` may turn a hit down, then the ray goes on.
  std::optional<Hit> first_hit(V3f const& origin, V3f const& direction, float near, float far) const;
  bool occluded(V3f const& origin, V3f const& direction, float near, float far) const;
  /// Closest point within `radius` on a face whose unit normal makes an acute angle with `side`; `side` 0: any face.
  std::optional<Hit> closest_point(V3f const& point, float radius, V3f const& side) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vitrine
