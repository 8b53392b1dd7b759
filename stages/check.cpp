// SPDX-License-Identifier: Apache-2.0
// The checks of data.h. Where they judge geometry they do it in their own way, not by the code of the stages they
// check.
#include "stages/chart_topology.h"
#include "stages/data.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <utility>

namespace vitrine {
namespace {

using Violations = std::vector<std::string>;
using Corners = std::array<Imath::V2d, 3>;

constexpr double kNoise = 2e-6;           ///< share of a chart's size below which folds and overlaps are rounding
constexpr double kAreaTolerance = 1e-3;   ///< share of a chart's area
constexpr double kTexelTolerance = 1e-3;  ///< by how much a chart may reach into a texel that it does not own

bool finite(V3f const& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }
bool finite(CornerUvs const& uvs) {
  return std::ranges::all_of(uvs, [](V2f const& p) { return std::isfinite(p.x) && std::isfinite(p.y); });
}

void require(bool holds, std::string violation, Violations& violations) {
  if (!holds) violations.push_back(std::move(violation));
}

void require_size(std::string const& what, std::size_t size, std::size_t wanted, Violations& violations) {
  require(size == wanted, what + ": " + std::to_string(size) + " of them, " + std::to_string(wanted) + " wanted",
          violations);
}

std::string number(std::string const& what, std::size_t i) { return what + " " + std::to_string(i); }

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

Corners upwards(CornerUvs const& uvs, double width = 1, double height = 1) {
  Corners corners;
  for (std::size_t i = 0; i < 3; ++i) corners[i] = {uvs[i].x * width, -uvs[i].y * height};
  return corners;
}

double area(Corners const& t) { return (t[1] - t[0]).cross(t[2] - t[0]) / 2; }

double longest_edge(Corners const& t) {
  return std::max({(t[1] - t[0]).length(), (t[2] - t[1]).length(), (t[0] - t[2]).length()});
}

/// By how much two triangles, counter-clockwise, overlap at least in the direction in which they do least.
double overlap(Corners const& a, Corners const& b) {
  double least = std::numeric_limits<double>::infinity();
  for (auto const* pair : {&a, &b}) {
    Corners const &of = *pair, &other = pair == &a ? b : a;
    for (std::size_t i = 0; i < 3; ++i) {
      Imath::V2d const along = (of[(i + 1) % 3] - of[i]).normalized();
      double deepest = 0;
      for (Imath::V2d const& p : other) deepest = std::max(deepest, along.cross(p - of[i]));
      least = std::min(least, deepest);
    }
  }
  return least;
}

struct PlacedFace {
  std::size_t face;
  Corners corners;
  double left, right;
};

double extent(std::vector<PlacedFace> const& faces) {
  Imath::Box2d box;
  for (PlacedFace const& f : faces)
    for (Imath::V2d const& p : f.corners) box.extendBy(p);
  return box.size().length();
}

std::vector<std::vector<PlacedFace>> placed_faces(std::vector<std::uint32_t> const& face_charts, std::uint32_t charts,
                                                  std::vector<CornerUvs> const& corner_uvs) {
  std::vector<std::vector<PlacedFace>> placed(charts);
  for (std::size_t f = 0; f < corner_uvs.size(); ++f) {
    Corners const c = upwards(corner_uvs[f]);
    auto const [left, right] = std::minmax({c[0].x, c[1].x, c[2].x});
    placed[face_charts[f]].push_back({f, c, left, right});
  }
  return placed;
}

void check_folds(std::vector<PlacedFace> const& faces, std::size_t chart, Violations& violations) {
  double const noise = kNoise * extent(faces);
  for (PlacedFace const& f : faces)
    require(2 * area(f.corners) >= -noise * longest_edge(f.corners),
            number("face", f.face) + " is flipped in chart " + std::to_string(chart), violations);
}

void check_overlaps(std::vector<PlacedFace> faces, std::size_t chart, Violations& violations) {
  double const noise = kNoise * extent(faces);
  std::ranges::sort(faces, {}, &PlacedFace::left);
  for (std::size_t i = 0; i < faces.size(); ++i)
    for (std::size_t j = i + 1; j < faces.size() && faces[j].left <= faces[i].right; ++j)
      if (area(faces[i].corners) > 0 && area(faces[j].corners) > 0 &&
          overlap(faces[i].corners, faces[j].corners) > noise)
        violations.push_back(number("faces", faces[i].face) + " and " + std::to_string(faces[j].face) +
                             " overlap in chart " + std::to_string(chart));
}

void check_area(TriMesh const& mesh, std::vector<PlacedFace> const& faces, std::size_t chart, Violations& violations) {
  double flat = 0, in_space = 0, slack = 0;
  for (PlacedFace const& f : faces) {
    auto const [a, b, c] = mesh.triangles[f.face];
    V3d const p(mesh.positions[a]), q(mesh.positions[b]), r(mesh.positions[c]);
    flat += area(f.corners);
    in_space += (q - p).cross(r - p).length() / 2;
    slack += kNoise * std::max({(q - p).length2(), (r - q).length2(), (p - r).length2()});
  }
  require(std::abs(flat - in_space) <= kAreaTolerance * in_space + slack,
          number("chart", chart) + ": area " + std::to_string(flat) + ", in space " + std::to_string(in_space),
          violations);
}

/// Whether the triangle reaches into the texel's square by more than the tolerance (separating axes).
bool touches(Corners const& t, int x, int y) {
  Imath::V2d const low(x + kTexelTolerance, y + kTexelTolerance),
      high(x + 1 - kTexelTolerance, y + 1 - kTexelTolerance);
  for (int axis = 0; axis < 2; ++axis)
    if (std::max({t[0][axis], t[1][axis], t[2][axis]}) < low[axis] ||
        std::min({t[0][axis], t[1][axis], t[2][axis]}) > high[axis])
      return false;
  for (std::size_t i = 0; i < 3; ++i) {
    Imath::V2d const along = t[(i + 1) % 3] - t[i];
    double const third = along.cross(t[(i + 2) % 3] - t[i]);
    bool beyond = true;
    for (double cx : {low.x, high.x})
      for (double cy : {low.y, high.y}) {
        double const side = along.cross(Imath::V2d(cx, cy) - t[i]);
        beyond &= third >= 0 ? side < 0 : side > 0;
      }
    if (beyond) return false;
  }
  return true;
}

/// Who touches each texel first; reports each pair of charts that meet in one.
std::vector<std::uint32_t> texel_owners(Atlas const& atlas, Violations& violations) {
  std::vector<std::uint32_t> owner(std::size_t(atlas.width) * std::size_t(atlas.height), kNone);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::string> clashes;
  for (std::size_t f = 0; f < atlas.corner_uvs.size(); ++f) {
    Corners t;
    for (std::size_t i = 0; i < 3; ++i)
      t[i] = {atlas.corner_uvs[f][i].x * double(atlas.width), atlas.corner_uvs[f][i].y * double(atlas.height)};
    auto const [left, right] = std::minmax({t[0].x, t[1].x, t[2].x});
    auto const [low, high] = std::minmax({t[0].y, t[1].y, t[2].y});
    for (int y = int(low); y <= std::min(int(high), atlas.height - 1); ++y)
      for (int x = int(left); x <= std::min(int(right), atlas.width - 1); ++x) {
        if (!touches(t, x, y)) continue;
        std::uint32_t& o = owner[std::size_t(y) * std::size_t(atlas.width) + std::size_t(x)];
        std::uint32_t const chart = atlas.face_charts[f];
        if (o == kNone) o = chart;
        if (o != chart)
          clashes.try_emplace(std::minmax(o, chart), number("charts", std::min(o, chart)) + " and " +
                                                         std::to_string(std::max(o, chart)) + " share texel " +
                                                         std::to_string(x) + ", " + std::to_string(y));
      }
  }
  for (auto& [charts, violation] : clashes) violations.push_back(std::move(violation));
  return owner;
}

void check_gutter(Atlas const& atlas, std::vector<std::uint32_t> const& owner, Violations& violations) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::string> close;
  int const border = atlas.gutter / 2;
  for (int y = 0; y < atlas.height; ++y)
    for (int x = 0; x < atlas.width; ++x) {
      auto const at = [&](int cx, int cy) {
        return owner[std::size_t(cy) * std::size_t(atlas.width) + std::size_t(cx)];
      };
      std::uint32_t const mine = at(x, y);
      if (mine == kNone) continue;
      std::string const place = " at texel " + std::to_string(x) + ", " + std::to_string(y);
      if (std::min({x, y, atlas.width - 1 - x, atlas.height - 1 - y}) < border)
        close.try_emplace({mine, mine}, number("chart", mine) + " lies in the border" + place);
      for (int cy = y; cy <= std::min(y + atlas.gutter, atlas.height - 1); ++cy)
        for (int cx = std::max(0, x - atlas.gutter); cx <= std::min(x + atlas.gutter, atlas.width - 1); ++cx)
          if (std::uint32_t const other = at(cx, cy); other != kNone && other != mine)
            close.try_emplace(std::minmax(mine, other), number("charts", std::min(mine, other)) + " and " +
                                                            std::to_string(std::max(mine, other)) + " keep no gutter" +
                                                            place);
    }
  for (auto& [charts, violation] : close) violations.push_back(std::move(violation));
}

void check_material(SourceModel const& model, std::size_t m, Violations& violations) {
  Material const& material = model.materials[m];
  for (TextureUse const* use : {&material.colour_map, &material.normal_map}) {
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
  auto const placed = placed_faces(charts.face_charts, charts.charts, charts.corner_uvs);
  for (std::size_t c = 0; c < placed.size(); ++c) {
    check_folds(placed[c], c, violations);
    check_overlaps(placed[c], c, violations);
    check_area(charts.mesh, placed[c], c, violations);
  }
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
  auto const placed = placed_faces(atlas.face_charts, atlas.charts, atlas.corner_uvs);
  for (std::size_t c = 0; c < placed.size(); ++c) check_folds(placed[c], c, violations);
  check_gutter(atlas, texel_owners(atlas, violations), violations);
  return violations;
}

}  // namespace vitrine
