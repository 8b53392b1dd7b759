// SPDX-License-Identifier: Apache-2.0
#include "stages/chart_topology.h"
#include "stages/violations.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace vitrine {
namespace {

using Corners = std::array<Imath::V2d, 3>;

constexpr double kNoise = 2e-6;           ///< share of a chart's size below which folds and overlaps are rounding
constexpr double kAreaTolerance = 1e-3;   ///< share of a chart's area
constexpr double kTexelTolerance = 1e-3;  ///< by how much a chart may reach into a texel that it does not own

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

}  // namespace

void check_folds(std::vector<std::uint32_t> const& face_charts, std::uint32_t charts,
                 std::vector<CornerUvs> const& corner_uvs, Violations& violations) {
  auto const placed = placed_faces(face_charts, charts, corner_uvs);
  for (std::size_t c = 0; c < placed.size(); ++c) check_folds(placed[c], c, violations);
}

void check_flatness(FlatCharts const& charts, Violations& violations) {
  auto const placed = placed_faces(charts.face_charts, charts.charts, charts.corner_uvs);
  for (std::size_t c = 0; c < placed.size(); ++c) {
    check_overlaps(placed[c], c, violations);
    check_area(charts.mesh, placed[c], c, violations);
  }
}

void check_gutters(Atlas const& atlas, Violations& violations) {
  check_gutter(atlas, texel_owners(atlas, violations), violations);
}

}  // namespace vitrine
