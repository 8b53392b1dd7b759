// SPDX-License-Identifier: Apache-2.0
#include "tools/sample/scan.h"

#include "stages/error.h"
#include "stages/parallel.h"

#include <limits>
#include <numeric>
#include <string>

namespace vitrine::sample {
namespace {

constexpr double kStep = 1e-4;  // of the parameter square, for tangents

/// Tangents of the smooth shape along u and v; one-sided at the ends of v and of open u.
std::pair<V3d, V3d> tangents(Part const& part, Uv uv) {
  // At a pole u means nothing: take the tangents a little beside it.
  uv.v = std::clamp(uv.v, kStep * 10, 1 - kStep * 10);
  uv.u = std::clamp(uv.u, kStep, 1 - kStep);
  auto const at = [&](double u, double v) { return part.place({u, v, uv.back}); };
  return {at(uv.u + kStep, uv.v) - at(uv.u - kStep, uv.v), at(uv.u, uv.v + kStep) - at(uv.u, uv.v - kStep)};
}

struct Extent {
  double area = 0, across = 0, down = 0;
};

/// Area and mean lengths of a part, from a coarse sampling.
Extent extent(Part const& part) {
  constexpr int kSide = 32;
  Extent total;
  for (int back = 0; back <= (part.topology == Topology::pillow ? 1 : 0); ++back)
    for (int i = 0; i < kSide * kSide; ++i) {
      auto const [across, down] = tangents(part, {(i % kSide + 0.5) / kSide, (i / kSide + 0.5) / kSide, back == 1});
      total.area += across.cross(down).length();
      total.across += across.length();
      total.down += down.length();
    }
  return total;
}

V3d normal(Part const& part, Uv const& uv, V3d const& base) {
  if (part.normal) return part.normal(base);
  auto const [across, down] = tangents(part, uv);
  return down.cross(across).normalized() * (uv.back ? -1 : 1);
}

std::uint8_t byte(double x) { return std::uint8_t(std::clamp(x, 0.0, 1.0) * 255 + 0.5); }

void sample(PartGrid const& grid, Scan& scan) {
  parallel_for(grid.grid.vertices(), 4096, [&](std::size_t i) {
    Uv const uv = grid.grid.place(grid.grid.split(std::uint32_t(i)), grid.seed);
    V3d const base = grid.part.place(uv);
    Finish const finish = grid.part.finish(uv, base);
    scan.positions[grid.first_vertex + i] = V3f(base + normal(grid.part, uv, base) * finish.height);
    scan.colours[grid.first_vertex + i] = {byte(finish.colour.x), byte(finish.colour.y), byte(finish.colour.z)};
  });
}

PartGrid const& part_of_triangle(Scan const& scan, std::uint64_t index) {
  auto const after = std::upper_bound(scan.parts.begin(), scan.parts.end(), index,
                                      [](std::uint64_t i, PartGrid const& part) { return i < part.first_triangle; });
  return *std::prev(after);
}

/// Rows of the texture that belong to a part, as its share of all split vertices.
struct Band {
  double top, bottom;
};
Band band(Scan const& scan, PartGrid const& part) {
  double const total = scan.split_vertices;
  return {part.first_split / total, (part.first_split + part.grid.split_vertices()) / total};
}

/// Pillows lie side by side: the front in the left half, the back in the right one.
double texture_u(PartGrid const& part, Uv const& uv) {
  return part.grid.topology() == Topology::pillow ? 0.5 * uv.u + (uv.back ? 0.5 : 0) : uv.u;
}

}  // namespace

Scan scan(std::vector<Part> parts, std::uint64_t triangles, std::uint32_t seed) {
  std::vector<Extent> extents;
  for (Part const& part : parts) extents.push_back(extent(part));
  double const area =
      std::accumulate(extents.begin(), extents.end(), 0.0, [](double sum, Extent const& e) { return sum + e.area; });
  if (double(triangles) > 0.9 * std::numeric_limits<std::uint32_t>::max())
    throw Error(ErrorKind::limit_exceeded, std::to_string(triangles) + " triangles are more than 32-bit indices reach",
                "ask for fewer triangles");

  Scan result;
  std::uint32_t vertices = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    Grid const grid(parts[i].topology, double(triangles) * extents[i].area / area, extents[i].across / extents[i].down);
    result.parts.push_back(
        {std::move(parts[i]), grid, vertices, result.split_vertices, result.triangles, seed + unsigned(i)});
    vertices += grid.vertices();
    result.split_vertices += grid.split_vertices();
    result.triangles += grid.triangles();
  }
  result.positions.resize(vertices);
  result.colours.resize(vertices);
  for (PartGrid const& part : result.parts) sample(part, result);
  return result;
}

Triangle split_triangle(Scan const& scan, std::uint64_t index) {
  PartGrid const& part = part_of_triangle(scan, index);
  Triangle triangle = part.grid.split_triangle(index - part.first_triangle);
  for (std::uint32_t& corner : triangle) corner += part.first_split;
  return triangle;
}

Triangle triangle(Scan const& scan, std::uint64_t index) {
  PartGrid const& part = part_of_triangle(scan, index);
  Triangle triangle = part.grid.split_triangle(index - part.first_triangle);
  for (std::uint32_t& corner : triangle) corner = part.first_vertex + part.grid.weld(corner);
  return triangle;
}

SplitVertex split_vertex(Scan const& scan, std::uint32_t index) {
  PartGrid const& part = *std::prev(
      std::upper_bound(scan.parts.begin(), scan.parts.end(), index,
                       [](std::uint32_t i, PartGrid const& candidate) { return i < candidate.first_split; }));
  std::uint32_t const own = index - part.first_split;
  Uv const uv = part.grid.place(own, part.seed);
  Band const rows = band(scan, part);
  return {part.first_vertex + part.grid.weld(own),
          V2f(float(texture_u(part, uv)), float(mix(rows.top, rows.bottom, uv.v)))};
}

Image texture(Scan const& scan, int width) {
  Image image{width, width, 3, ColourSpace::srgb, std::vector<std::uint8_t>(3 * std::size_t(width) * width)};
  for (PartGrid const& part : scan.parts) {
    Band const rows = band(scan, part);
    auto const top = std::size_t(rows.top * width),
               bottom = std::min<std::size_t>(width, std::size_t(rows.bottom * width) + 1);
    parallel_for(bottom - top, 8, [&](std::size_t y) {
      double const v =
          std::clamp((double(top + y) + 0.5 - rows.top * width) / ((rows.bottom - rows.top) * width), 0.0, 1.0);
      for (int x = 0; x < width; ++x) {
        double const across = (x + 0.5) / width;
        bool const pillow = part.grid.topology() == Topology::pillow;
        Uv const uv = pillow ? Uv{across < 0.5 ? 2 * across : 2 * across - 1, v, across >= 0.5} : Uv{across, v, false};
        V3d const colour = part.part.finish(uv, part.part.place(uv)).colour;
        for (int c = 0; c < 3; ++c) image.texels[3 * ((top + y) * width + x) + c] = byte(colour[c]);
      }
    });
  }
  return image;
}

}  // namespace vitrine::sample
