// SPDX-License-Identifier: Apache-2.0
#include "stages/view.h"

#include "stages/error.h"

#include <Imath/ImathBox.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vitrine {
namespace {

using std::numbers::pi;

constexpr double kHalfAngle = pi / 12;

V3d around(double turn, double height, double radius) {
  return {std::sin(turn) * radius, height, std::cos(turn) * radius};
}

V3d turntable_direction(int i, int count) {
  constexpr double rise = pi / 18;
  return around(2 * pi * i / count, std::sin(rise), std::cos(rise));
}

V3d fibonacci_direction(int i, int count) {
  double const golden_angle = pi * (3 - std::sqrt(5.0));
  double const height = 1 - (2.0 * i + 1) / count;
  return around(i * golden_angle, height, std::sqrt(1 - height * height));
}

}  // namespace

std::vector<V3d> directions(ViewSet set, int count) {
  std::vector<V3d> all;
  for (int i = 0; i < count; ++i)
    all.push_back(set == ViewSet::turntable ? turntable_direction(i, count) : fibonacci_direction(i, count));
  return all;
}

BoundingSphere bounding_sphere(SourceModel const& model) {
  std::vector<V3f> const& positions = model.mesh.positions;
  Imath::Box3d box;
  for (Triangle const& face : model.mesh.triangles)
    for (std::uint32_t v : face) box.extendBy(V3d(positions[v]));
  V3d const centre = box.center();
  double squared = 0;
  for (Triangle const& face : model.mesh.triangles)
    for (std::uint32_t v : face) squared = std::max(squared, (V3d(positions[v]) - centre).length2());
  if (!(squared > 0) || !std::isfinite(squared))
    throw Error(ErrorKind::invalid_input, "its bounding sphere has radius " + std::to_string(std::sqrt(squared)),
                "check the positions in the file");
  return {centre + model.origin, std::sqrt(squared)};
}

Camera camera(BoundingSphere const& sphere, V3d const& direction) {
  double const distance = sphere.radius / std::sin(kHalfAngle);
  V3d const forward = -direction;
  V3d const right = forward.cross({0, 1, 0}).normalized();
  return {sphere.centre + direction * distance, right, right.cross(forward), forward, distance - 1.5 * sphere.radius,
          distance + 1.5 * sphere.radius};
}

V3d through(Camera const& camera, double x, double y) {
  static double const reach = std::tan(kHalfAngle);
  return camera.forward + camera.right * (x * reach) + camera.up * (y * reach);
}

}  // namespace vitrine
