// SPDX-License-Identifier: Apache-2.0
// The checks of data.h. Where they judge geometry they do it in their own way, not by the code of the stages they
// check.
#include "stages/chart_topology.h"
#include "stages/data.h"
#include "stages/violations.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <utility>

namespace vitrine {
namespace {

bool finite(V3f const& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }
bool finite(CornerUvs const& uvs) {
  return std::ranges::all_of(uvs, [](V2f const& p) { return std::isfinite(p.x) && std::isfinite(p.y); });
}

void require_size(std::string const& what, std::size_t size, std::size_t wanted, Violations& violations) {
  require(size == wanted, what + ": " + std::to_string(size) + " of them, " + std::to_string(wanted) + " wanted",
          violations);
}

void check_charts(std::size_t faces, std::vector<std::uint32_t> const& face_charts, std::uint32_t charts,
                  Violations& violations) {
  require_size("chart ids", face_charts.size(), faces, violations);
  std::vector<bool> used(charts);
  for (std::size_t f = 0; f < face_charts.size(); ++f)
    if (face_charts[f] < charts)
      used[face_charts[f]] = true;
    else
      violations.push_back(number("face", f) + ": chart " + std::to_string(face_charts[f]) + " of " +
                           std::to_string(charts));
  for (std::size_t c = 0; c < charts; ++c) require(used[c], number("chart", c) + " has no face", violations);
}

void check_disks(TriMesh const& mesh, std::vector<std::uint32_t> const& face_charts, std::uint32_t charts,
                 Violations& violations) {
  std::vector<std::vector<Triangle>> triangles(charts);
  for (std::size_t f = 0; f < face_charts.size(); ++f) triangles[face_charts[f]].push_back(mesh.triangles[f]);
  for (std::size_t c = 0; c < charts; ++c)
    if (std::string const defect = disk_defect(triangles[c]); !defect.empty())
      violations.push_back(number("chart", c) + " " + defect);
}

/// Finite, and each vertex at one place within a chart.
void check_uvs(TriMesh const& mesh, std::vector<std::uint32_t> const& face_charts,
               std::vector<CornerUvs> const& corner_uvs, Violations& violations) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, V2f> place;
  for (std::size_t f = 0; f < corner_uvs.size(); ++f) {
    require(finite(corner_uvs[f]), number("face", f) + ": a texture coordinate is not finite", violations);
    for (std::size_t i = 0; i < 3; ++i) {
      auto const [entry, is_new] = place.try_emplace({face_charts[f], mesh.triangles[f][i]}, corner_uvs[f][i]);
      require(is_new || entry->second == corner_uvs[f][i],
              number("vertex", mesh.triangles[f][i]) + ": two places in chart " + std::to_string(face_charts[f]),
              violations);
    }
  }
}

void check_material(SourceModel const& model, std::size_t m, Violations& violations) {
  Material const& material = model.materials[m];
  for (TextureUse const* use : {&material.colour_map, &material.normal_map, &material.emission_map}) {
    require(
        use->image < int(model.images.size()),
        number("material", m) + ": image " + std::to_string(use->image) + " of " + std::to_string(model.images.size()),
        violations);
    require(std::ranges::all_of(use->matrix, [](float x) { return std::isfinite(x); }),
            number("material", m) + ": its texture transform is not finite", violations);
  }
  require(std::ranges::all_of(material.base_colour, [](float x) { return std::isfinite(x); }),
          number("material", m) + ": its colour is not finite", violations);
}

void check_image(Image const& image, std::size_t i, Violations& violations) {
  require(image.width > 0 && image.height > 0 && image.channels >= 1 && image.channels <= 4,
          number("image", i) + " has no size", violations);
  require(
      image.texels.size() == std::uint64_t(image.width) * std::uint64_t(image.height) * std::uint64_t(image.channels),
      number("image", i) + ": its texels do not match its size", violations);
}

}  // namespace

Violations check(TriMesh const& mesh) {
  Violations violations;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    require(finite(mesh.positions[v]), number("vertex", v) + " is not finite", violations);
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    auto const [a, b, c] = mesh.triangles[f];
    for (std::uint32_t v : {a, b, c})
      require(v < mesh.positions.size(),
              number("face", f) + ": vertex " + std::to_string(v) + " of " + std::to_string(mesh.positions.size()),
              violations);
    require(a != b && b != c && c != a, number("face", f) + " uses a vertex twice", violations);
  }
  return violations;
}

Violations check(SourceModel const& model) {
  Violations violations = check(model.mesh);
  std::size_t const n = model.mesh.positions.size();
  if (!model.normals.empty()) require_size("normals", model.normals.size(), n, violations);
  if (!model.uvs.empty()) require_size("texture coordinates", model.uvs.size(), n, violations);
  if (!model.colours.empty()) require_size("colours", model.colours.size(), n, violations);
  if (!model.face_materials.empty())
    require_size("materials of faces", model.face_materials.size(), model.mesh.triangles.size(), violations);
  for (std::size_t v = 0; v < model.normals.size(); ++v)
    require(finite(model.normals[v]) && std::abs(model.normals[v].length() - 1) < 1e-3f,
            number("normal", v) + " is not of length 1", violations);
  for (std::size_t v = 0; v < model.uvs.size(); ++v)
    require(std::isfinite(model.uvs[v].x) && std::isfinite(model.uvs[v].y),
            number("texture coordinate", v) + " is not finite", violations);
  for (std::size_t f = 0; f < model.face_materials.size(); ++f)
    require(model.face_materials[f] < model.materials.size(),
            number("face", f) + ": material " + std::to_string(model.face_materials[f]) + " of " +
                std::to_string(model.materials.size()),
            violations);
  require(!model.materials.empty(), "no material", violations);
  for (std::size_t m = 0; m < model.materials.size(); ++m) check_material(model, m, violations);
  for (std::size_t i = 0; i < model.images.size(); ++i) check_image(model.images[i], i, violations);
  return violations;
}

Violations check(ChartedMesh const& charts) {
  Violations violations = check(charts.mesh);
  check_charts(charts.mesh.triangles.size(), charts.face_charts, charts.charts, violations);
  if (violations.empty()) check_disks(charts.mesh, charts.face_charts, charts.charts, violations);
  return violations;
}

Violations check(FlatCharts const& charts) {
  Violations violations = check(ChartedMesh{charts.mesh, charts.face_charts, charts.charts});
  require_size("faces with texture coordinates", charts.corner_uvs.size(), charts.mesh.triangles.size(), violations);
  require_size("stretches", charts.stretch.size(), charts.charts, violations);
  for (std::size_t c = 0; c < charts.stretch.size(); ++c)
    require(std::isfinite(charts.stretch[c]) && charts.stretch[c] > 0,
            number("chart", c) + ": stretch " + std::to_string(charts.stretch[c]), violations);
  if (!violations.empty()) return violations;
  check_uvs(charts.mesh, charts.face_charts, charts.corner_uvs, violations);
  if (!violations.empty()) return violations;
  check_folds(charts.face_charts, charts.charts, charts.corner_uvs, violations);
  check_flatness(charts, violations);
  return violations;
}

Violations check(Atlas const& atlas) {
  Violations violations = check(atlas.mesh);
  check_charts(atlas.mesh.triangles.size(), atlas.face_charts, atlas.charts, violations);
  require_size("faces with texture coordinates", atlas.corner_uvs.size(), atlas.mesh.triangles.size(), violations);
  require(atlas.width > 0 && atlas.height > 0, "no texels", violations);
  require(atlas.gutter >= 0, "a negative gutter", violations);
  require(atlas.fill >= 0 && atlas.fill <= 1, "a fill of " + std::to_string(atlas.fill), violations);
  if (!violations.empty()) return violations;
  check_uvs(atlas.mesh, atlas.face_charts, atlas.corner_uvs, violations);
  for (std::size_t f = 0; f < atlas.corner_uvs.size(); ++f)
    for (V2f const& uv : atlas.corner_uvs[f])
      require(uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1, number("face", f) + " reaches out of the texture",
              violations);
  if (!violations.empty()) return violations;
  check_folds(atlas.face_charts, atlas.charts, atlas.corner_uvs, violations);
  check_gutters(atlas, violations);
  return violations;
}

}  // namespace vitrine
