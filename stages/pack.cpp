// SPDX-License-Identifier: Apache-2.0
#include "stages/pack.h"

#include "stages/chart_topology.h"
#include "stages/error.h"
#include "stages/texel_mask.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>

namespace vitrine {
namespace {

constexpr double kInset =
    1.0 / 64;  ///< texels between a chart's box and the texel grid, so that a dot of a chart owns one texel
constexpr double kSmallest = 0.25;         ///< texels: at this size of the largest chart each chart is but a dot
constexpr double kScalePrecision = 1.005;  ///< the search for the common scale stops here
constexpr double kUsualFill = 0.85;        ///< of the square, gutters included: where the search starts
constexpr double kStep = 0.95;             ///< while nothing fits, or everything
constexpr int kMostCells = 640;            ///< along a side: larger atlases are packed by squares of several texels

using Corners = std::array<V2d, 3>;

/// A chart in model units, turned so that its smallest bounding rectangle is upright.
struct Shape {
  std::vector<std::uint32_t> faces;
  std::vector<Corners> corners;  ///< of those faces
  double area = 0;
};

/// Where a chart lies: turned, scaled, then moved so that its box's corner lies at `origin`, in texels.
struct Placement {
  V2d axis{1, 0};  ///< cosine and sine of the turn
  V2d low{0, 0};   ///< lowest corner of the turned chart's box, in model units
  V2d origin{0, 0};
};

V2d turn(V2d p, V2d axis) { return {p.x * axis.x - p.y * axis.y, p.x * axis.y + p.y * axis.x}; }

Imath::Box2d box_of(Shape const& shape, V2d axis) {
  Imath::Box2d box;
  for (Corners const& t : shape.corners)
    for (V2d p : t) box.extendBy(turn(p, axis));
  return box;
}

/// Convex hull, counter-clockwise (Andrew's monotone chain).
std::vector<V2d> convex_hull(std::vector<V2d> points) {
  std::sort(points.begin(), points.end(),
            [](V2d const& p, V2d const& q) { return std::pair(p.x, p.y) < std::pair(q.x, q.y); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  std::vector<V2d> hull;
  for (int side = 0; side < 2; ++side) {
    std::size_t const start = hull.size();
    for (V2d p : points) {
      while (hull.size() >= start + 2 && (hull.back() - hull[hull.size() - 2]).cross(p - hull.back()) <= 0)
        hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();  // starts the other side
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

/// The turn after which the upright box is smallest: one side of it runs along an edge of the hull.
V2d upright_turn(Shape const& shape) {
  std::vector<V2d> points;
  for (Corners const& t : shape.corners) points.insert(points.end(), t.begin(), t.end());
  std::vector<V2d> const hull = convex_hull(std::move(points));
  V2d best(1, 0);
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < hull.size(); ++i) {
    V2d const along = (hull[(i + 1) % hull.size()] - hull[i]).normalized(), axis(along.x, -along.y);
    if (along.length2() == 0) continue;
    Imath::Box2d box;
    for (V2d p : hull) box.extendBy(turn(p, axis));
    if (double const area = box.size().x * box.size().y; area < smallest) smallest = area, best = axis;
  }
  return best;
}

std::vector<Shape> shapes_of(FlatCharts const& charts) {
  std::vector<Shape> shapes(charts.charts);
  auto faces = faces_of_charts(charts.face_charts, charts.charts);
  for (std::size_t c = 0; c < shapes.size(); ++c) {
    for (std::uint32_t f : faces[c]) {
      CornerUvs const& uv = charts.corner_uvs[f];
      shapes[c].corners.push_back({V2d(uv[0]), V2d(uv[1]), V2d(uv[2])});
      shapes[c].area += std::abs((V2d(uv[1]) - V2d(uv[0])).cross(V2d(uv[2]) - V2d(uv[0]))) / 2;
    }
    shapes[c].faces = std::move(faces[c]);
  }
  return shapes;
}

/// The texels that a shape touches, turned by `axis` and scaled, its box's lowest corner kInset from the mask's.
TexelMask rasterise(Shape const& shape, V2d axis, double scale) {
  Imath::Box2d const box = box_of(shape, axis);
  V2d const size = box.size() * scale;
  TexelMask mask(int(size.x + 2 * kInset) + 1, int(size.y + 2 * kInset) + 1);
  for (Corners const& t : shape.corners) {
    Corners moved;
    for (std::size_t i = 0; i < 3; ++i) moved[i] = (turn(t[i], axis) - box.min) * scale + V2d(kInset);
    mask.cover(moved);
  }
  return mask;
}

/// Largest area first; ties by index.
std::vector<std::size_t> largest_first(std::vector<Shape> const& shapes) {
  std::vector<std::size_t> order(shapes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::greater(), [&](std::size_t c) { return shapes[c].area; });
  return order;
}

using Layout = std::vector<Placement>;

/// Puts each shape, in the best of eight turns, at the lowest free place; empty if one finds none. `side`: of the
/// square.
std::optional<Layout> place_shapes(std::vector<Shape> const& shapes, std::vector<V2d> const& upright, double scale,
                                   int side, int gutter) {
  constexpr double kDiagonal = std::numbers::sqrt2 / 2;
  static constexpr std::array<std::pair<double, double>, 8> kTurns{{{1, 0},
                                                                    {0, 1},
                                                                    {-1, 0},
                                                                    {0, -1},
                                                                    {kDiagonal, kDiagonal},
                                                                    {-kDiagonal, kDiagonal},
                                                                    {-kDiagonal, -kDiagonal},
                                                                    {kDiagonal, -kDiagonal}}};
  TexelMask taken(side, side);
  Layout layout(shapes.size());
  for (std::size_t c : largest_first(shapes)) {
    std::optional<std::pair<TexelMask, V2i>> best;
    for (auto const& [cosine, sine] : kTurns) {
      V2d const axis = turn(upright[c], {cosine, sine});
      TexelMask mask = rasterise(shapes[c], axis, scale);
      std::optional<V2i> const place = taken.room_for(mask);
      if (!place) continue;
      auto const top_then_left = [](TexelMask const& m, V2i at) { return std::pair(at.y + m.height(), at.x); };
      if (best && top_then_left(best->first, best->second) <= top_then_left(mask, *place)) continue;
      layout[c] = {axis, box_of(shapes[c], axis).min, V2d(place->x + kInset, place->y + kInset)};
      best.emplace(std::move(mask), *place);
    }
    if (!best) return std::nullopt;
    taken.add(best->first, best->second, gutter);
  }
  return layout;
}

/// The same by squares of `cell` texels.
std::optional<Layout> place_shapes_by(int cell, std::vector<Shape> const& shapes, std::vector<V2d> const& upright,
                                      double scale, int side, int gutter) {
  auto layout = place_shapes(shapes, upright, scale / cell, side / cell, (gutter + cell - 1) / cell);
  if (layout)
    for (Placement& placement : *layout) placement.origin *= cell;
  return layout;
}

/// Puts the shapes' upright boxes on shelves, the highest first; empty if they need more than the square.
std::optional<Layout> place_boxes(std::vector<Shape> const& shapes, std::vector<V2d> const& upright, double scale,
                                  int side, int gutter) {
  struct Rectangle {
    std::size_t chart;
    int width, height;
  };
  std::vector<Rectangle> rectangles;
  Layout layout(shapes.size());
  for (std::size_t c = 0; c < shapes.size(); ++c) {
    Imath::Box2d box = box_of(shapes[c], layout[c].axis = upright[c]);
    if (box.size().y > box.size().x) box = box_of(shapes[c], layout[c].axis = turn(upright[c], {0, 1}));
    layout[c].low = box.min;
    V2d const size = box.size() * scale;
    rectangles.push_back({c, int(size.x + 2 * kInset) + 1, int(size.y + 2 * kInset) + 1});
  }
  std::ranges::stable_sort(rectangles, std::greater(), &Rectangle::height);
  int x = 0, y = 0, next_shelf = 0;
  for (auto const& [chart, width, height] : rectangles) {
    if (x + width > side) x = 0, y = next_shelf;
    if (x + width > side || y + height > side) return std::nullopt;
    layout[chart].origin = V2d(x + kInset, y + kInset);
    next_shelf = std::max(next_shelf, y + height + gutter);
    x += width + gutter;
  }
  return layout;
}

/// The largest scale between the given ones at which place(scale) finds a layout, and that layout: from `start` down
/// or up by steps, then by bisection. 0 if there is none.
template <class Place>
std::pair<double, Layout> largest_scale(double start, double smallest, double largest, Place const& place) {
  double fits = 0, too_large = largest;
  Layout best;
  for (double scale = std::min(start, largest); too_large > fits * kScalePrecision && scale >= kStep * smallest;) {
    if (std::optional<Layout> layout = place(scale)) {
      fits = scale;
      best = std::move(*layout);
    } else {
      too_large = scale;
    }
    scale = fits == 0 ? scale * kStep : std::min(fits / kStep, std::sqrt(fits * too_large));
  }
  return {fits, std::move(best)};
}

/// Scale at which the charts, each with half a gutter and half a texel around it, would take kUsualFill of the square.
double likely_scale(std::vector<Shape> const& shapes, std::vector<V2d> const& upright, int side, int gutter) {
  double area = 0, rim = 0;  // grow with the square of the scale, and with the scale
  for (std::size_t c = 0; c < shapes.size(); ++c) {
    V2d const size = box_of(shapes[c], upright[c]).size();
    area += shapes[c].area;
    rim += (size.x + size.y) * (gutter + 1);
  }
  double const dots = double(shapes.size()) * (gutter + 1) * (gutter + 1);
  double const room = std::max(kUsualFill * side * side - dots, 1.0);
  double const slope = rim + std::sqrt(rim * rim + 4 * area * room);
  return slope > 0 ? 2 * room / slope : 1;
}

std::size_t texels_covered(Atlas const& atlas) {
  TexelMask mask(atlas.width, atlas.height);
  for (CornerUvs const& uv : atlas.corner_uvs) {
    Corners corners;
    for (std::size_t i = 0; i < 3; ++i) corners[i] = V2d(uv[i].x * double(atlas.width), uv[i].y * double(atlas.height));
    mask.cover(corners);
  }
  return mask.count();
}

}  // namespace

Atlas pack(FlatCharts const& charts, PackOptions const& options) {
  std::vector<Shape> const shapes = shapes_of(charts);
  std::vector<V2d> upright;
  double largest = 0;
  for (Shape const& shape : shapes) {
    upright.push_back(upright_turn(shape));
    V2d const size = box_of(shape, upright.back()).size();
    largest = std::max({largest, size.x, size.y});
  }
  int const border = (options.gutter + 1) / 2, side = std::max(0, options.texture - 2 * border);
  auto const place = [&](double scale) {
    return options.packing == Packing::shapes
               ? place_shapes_by(1 + side / kMostCells, shapes, upright, scale, side, options.gutter)
               : place_boxes(shapes, upright, scale, side, options.gutter);
  };
  double const unit = largest > 0 ? largest : 1;
  auto const [scale, layout] = largest_scale(likely_scale(shapes, upright, side, options.gutter), kSmallest / unit,
                                             std::numbers::sqrt2 * side / unit, place);
  if (scale == 0)
    throw Error(ErrorKind::limit_exceeded,
                std::to_string(charts.charts) + " charts with a gutter of " + std::to_string(options.gutter) +
                    " texels do not fit in " + std::to_string(options.texture) + " x " +
                    std::to_string(options.texture) + " texels",
                "use a larger --texture or fewer --triangles");

  Atlas atlas;
  atlas.mesh = charts.mesh;
  atlas.face_charts = charts.face_charts;
  atlas.charts = charts.charts;
  atlas.width = atlas.height = options.texture;
  atlas.gutter = options.gutter;
  atlas.corner_uvs.resize(charts.corner_uvs.size());
  for (std::size_t c = 0; c < shapes.size(); ++c)
    for (std::size_t i = 0; i < shapes[c].faces.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        V2d const at =
            (turn(shapes[c].corners[i][k], layout[c].axis) - layout[c].low) * scale + layout[c].origin + V2d(border);
        atlas.corner_uvs[shapes[c].faces[i]][k] = V2f(at / double(options.texture));
      }
  atlas.fill = float(double(texels_covered(atlas)) / (double(options.texture) * options.texture));
  return atlas;
}

}  // namespace vitrine
