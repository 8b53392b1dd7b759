// SPDX-License-Identifier: Apache-2.0
#include "stages/chart_tangents.h"

#include <algorithm>

namespace vitrine {
namespace {

constexpr V3f kAxes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

/// Grows as the squared cotangent of the angle between normal and axis, up to 100 where they are one.
double cost(double cosine) { return cosine * cosine / (1.01 - cosine * cosine); }

}  // namespace

std::vector<V3f> chart_tangents(Atlas const& atlas, std::vector<V3f> const& normals) {
  std::vector<std::array<double, 3>> costs(atlas.charts, {0, 0, 0});
  for (std::size_t f = 0; f < atlas.mesh.triangles.size(); ++f) {
    auto const [a, b, c] = atlas.mesh.triangles[f];
    std::vector<V3f> const& p = atlas.mesh.positions;
    double const area = (p[b] - p[a]).cross(p[c] - p[a]).length();
    for (std::uint32_t const vertex : {a, b, c})
      for (unsigned k = 0; k < 3; ++k) costs[atlas.face_charts[f]][k] += area * cost(normals[vertex][k]);
  }
  std::vector<V3f> tangents;
  tangents.reserve(atlas.charts);
  for (auto const& chart : costs) tangents.push_back(kAxes[std::ranges::min_element(chart) - chart.begin()]);
  return tangents;
}

}  // namespace vitrine
