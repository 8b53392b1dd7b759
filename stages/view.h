// SPDX-License-Identifier: Apache-2.0
#pragma once
/// From where an object is looked at. The original alone decides: its thumbnail is seen from the same cameras, so that
/// a shift, turn or scale counts as error.

#include "stages/data.h"
#include "stages/options.h"

#include <vector>

namespace vitrine {

enum class ViewSet {
  turntable,  ///< equal steps about +Y, 10 degrees above the horizon
  sphere      ///< a Fibonacci sphere: from all sides alike
};
template <>
struct EnumNames<ViewSet> {
  static constexpr std::array<std::string_view, 2> names{"turntable", "sphere"};
};

/// Unit vectors from the object to the camera.
std::vector<V3d> directions(ViewSet set, int count);

/// About the middle of the bounding box, out to the farthest vertex; in the file's coordinates (origin added).
struct BoundingSphere {
  V3d centre{0, 0, 0};
  double radius = 0;
};

/// Of the vertices that faces use. Errors: InvalidInput when there are none, or they all lie in one place.
BoundingSphere bounding_sphere(SourceModel const& model);

/// A perspective camera of 30 degrees, upright, from where the sphere just fits the square picture.
struct Camera {
  V3d eye, right, up, forward;  ///< the axes are unit vectors
  double near = 0, far = 0;     ///< depths along `forward` between which things are drawn
};

/// `direction`: unit, from the object to the camera; not +Y or -Y, where no side is up.
Camera camera(BoundingSphere const& sphere, V3d const& direction);

/// Ray direction (depth 1 along `forward`) through a point of the picture, x and y in [-1, 1], y up.
V3d through(Camera const& camera, double x, double y);

}  // namespace vitrine
