// SPDX-License-Identifier: Apache-2.0
#include "stages/angle_error.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace vitrine {
namespace {

V3f normal_at(Image const& map, std::size_t texel) {
  std::uint8_t const* bytes = &map.texels[3 * texel];
  return V3f(bytes[0], bytes[1], bytes[2]) * (2 / 255.f) - V3f(1);
}

float degrees_between(V3f const& a, V3f const& b) {
  return std::atan2(a.cross(b).length(), a.dot(b)) * (180 / std::numbers::pi_v<float>);
}

}  // namespace

AngleError angle_error(Image const& map, Image const& coded) {
  std::vector<float> angles(map.texels.size() / 3);
  if (angles.empty()) return {};
  for (std::size_t i = 0; i < angles.size(); ++i) angles[i] = degrees_between(normal_at(map, i), normal_at(coded, i));
  auto const quantile = [&](std::size_t percent) {
    auto const place = angles.begin() + std::ptrdiff_t((angles.size() - 1) * percent / 100);
    std::nth_element(angles.begin(), place, angles.end());
    return *place;
  };
  return {quantile(50), quantile(99)};
}

}  // namespace vitrine
