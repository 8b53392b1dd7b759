// SPDX-License-Identifier: Apache-2.0
#include "stages/deviation.h"

#include "stages/parallel.h"
#include "stages/view.h"

#include <algorithm>
#include <limits>

namespace vitrine {

double deviation(TriMesh const& light, SurfaceSamples const& samples) {
  constexpr float infinite = std::numeric_limits<float>::infinity();
  if (light.triangles.empty()) return infinite;
  RayScene const scene(light);
  auto const farthest = [&](std::size_t begin, std::size_t end) {
    float most = 0;
    for (std::size_t i = begin; i < end; ++i) {
      auto const hit = scene.closest_point(samples.points[i], infinite, V3f(0));
      most = std::max(most, hit ? hit->distance : infinite);
    }
    return most;
  };
  auto const larger = [](float a, float b) { return std::max(a, b); };
  return parallel_reduce(samples.points.size(), 4096, 0.f, farthest, larger);
}

double pixel_length(double sphere_radius, int size) {
  Camera const seen = camera({V3d(0), sphere_radius}, V3d(0, 0, 1));
  double const depth = seen.eye.length();
  return depth * (through(seen, 2.0 / size, 0) - through(seen, 0, 0)).length();
}

}  // namespace vitrine
