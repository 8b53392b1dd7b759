// SPDX-License-Identifier: Apache-2.0
#include "tests/support/atlases.h"

#include <cmath>
#include <utility>

namespace vitrine::test {

Atlas scattered_atlas(TriMesh mesh, int size, int gutter) {
  Atlas atlas{std::move(mesh), {}, 0, {}, size, size, gutter, 0};
  atlas.charts = std::uint32_t(atlas.mesh.triangles.size());
  int const columns = int(std::ceil(std::sqrt(double(atlas.charts))));
  float const cell = 1.f / float(columns), margin = 0.5f * float(gutter) / float(size);
  for (std::uint32_t f = 0; f < atlas.charts; ++f) {
    V2f const low(float(int(f) % columns) * cell + margin, float(int(f) / columns) * cell + margin);
    V2f const high = low + V2f(cell - 2 * margin);
    CornerUvs uvs{V2f(low.x, high.y), V2f(high.x, high.y), V2f(low.x, low.y)};
    if (f % 3 == 2) std::swap(uvs[1], uvs[2]);
    atlas.face_charts.push_back(f);
    atlas.corner_uvs.push_back(uvs);
  }
  atlas.fill = 0.5f * (1 - 2 * margin / cell) * (1 - 2 * margin / cell);
  return atlas;
}

Atlas facing_atlas(TriMesh mesh, int size) {
  Atlas atlas{std::move(mesh), {}, 1, {}, size, size, 2, 1};
  float const margin = 1.f / float(size);
  for (Triangle const& face : atlas.mesh.triangles) {
    CornerUvs uvs;
    for (int k = 0; k < 3; ++k) {
      V3f const& p = atlas.mesh.positions[face[k]];
      uvs[k] = V2f(margin) + V2f(p.x, 1 - p.y) * (1 - 2 * margin);
    }
    atlas.face_charts.push_back(0);
    atlas.corner_uvs.push_back(uvs);
  }
  return atlas;
}

}  // namespace vitrine::test
