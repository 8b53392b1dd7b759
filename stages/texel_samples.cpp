// SPDX-License-Identifier: Apache-2.0
#include "stages/texel_samples.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace vitrine {
namespace {

using Imath::V2d;

constexpr int kTile = 32;
constexpr double kReach2 = 2;            // square of the distance from which bilinear lookup reads a texel
constexpr double kCircumscribed2 = 0.5;  // of the circle about a texel's square
constexpr double kOnEdge = 1e-9;         // barycentric: samples on an edge belong to one of its faces, not to none
constexpr double kUnreached = std::numeric_limits<double>::infinity();
constexpr std::uint32_t kNoFace = 0xffffffffu;

/// A face in texels.
struct FlatFace {
  V2d a, ab, ac;
  double area = 0;  // twice, signed

  FlatFace(Atlas const& atlas, std::uint32_t face) {
    CornerUvs const& uv = atlas.corner_uvs[face];
    auto const texels = [&](V2f const& at) { return V2d(double(at.x) * atlas.width, double(at.y) * atlas.height); };
    a = texels(uv[0]);
    ab = texels(uv[1]) - a;
    ac = texels(uv[2]) - a;
    area = ab.cross(ac);
  }

  std::optional<Barycentric> covers(V2d const& point) const {
    if (area == 0) return std::nullopt;
    V2d const p = point - a;
    double const u = p.cross(ac) / area, v = ab.cross(p) / area;
    if (u < -kOnEdge || v < -kOnEdge || u + v > 1 + kOnEdge) return std::nullopt;
    return Barycentric{float(u), float(v)};
  }
};

/// Texels [low, high) of one axis whose centres a face may reach.
struct Range {
  int low, high;

  Range(double a, double b, double c, int begin, int end) {
    double const reach = std::sqrt(kReach2);
    low = std::max(begin, int(std::floor(std::min({a, b, c}) - reach)));
    high = std::min(end, int(std::ceil(std::max({a, b, c}) + reach)));
  }
};

Range columns_of(FlatFace const& f, int begin, int end) { return {f.a.x, f.a.x + f.ab.x, f.a.x + f.ac.x, begin, end}; }
Range rows_of(FlatFace const& f, int begin, int end) { return {f.a.y, f.a.y + f.ab.y, f.a.y + f.ac.y, begin, end}; }

/// One texel's sub-grid and centre while faces are drawn.
struct Drawing {
  int side;
  std::vector<SurfacePoint> samples, centres;  // side x side by texel; one by texel
  std::vector<double> distances;               // of the centre, along the longer axis as bilinear lookup counts

  Drawing(std::size_t texels, int per_side)
      : side(per_side),
        samples(texels * per_side * per_side, SurfacePoint{kNoFace, {}}),
        centres(texels),
        distances(texels, kUnreached) {}

  void draw(FlatFace const& flat, std::uint32_t face, V2d const& corner, std::size_t texel) {
    V2d const from = corner + V2d(0.5) - flat.a;
    Barycentric const closest = closest_on_triangle(from, flat.ab, flat.ac);
    V2d const gap = from - flat.ab * closest.u - flat.ac * closest.v;
    if (gap.length2() >= kReach2) return;
    double const distance = std::max(std::abs(gap.x), std::abs(gap.y));
    if (distance < distances[texel]) {
      distances[texel] = distance;
      centres[texel] = {face, closest};
    }
    if (gap.length2() > kCircumscribed2) return;
    SurfacePoint* slot = &samples[texel * side * side];
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x, ++slot) {
        if (slot->face != kNoFace) continue;
        if (auto const at = flat.covers(corner + (V2d(x, y) + V2d(0.5)) / side)) *slot = {face, *at};
      }
  }
};

}  // namespace

AtlasRaster::AtlasRaster(Atlas const& atlas, int side)
    : atlas_(atlas), side_(side), columns_((atlas.width + kTile - 1) / kTile) {
  int const rows = (atlas.height + kTile - 1) / kTile;
  tile_faces_.resize(std::size_t(columns_) * rows);
  for (std::uint32_t face = 0; face < atlas.corner_uvs.size(); ++face) {
    FlatFace const flat(atlas, face);
    Range const x = columns_of(flat, 0, atlas.width), y = rows_of(flat, 0, atlas.height);
    for (int row = y.low / kTile; row * kTile < y.high; ++row)
      for (int column = x.low / kTile; column * kTile < x.high; ++column)
        tile_faces_[std::size_t(row) * columns_ + column].push_back(face);
  }
}

TexelTile AtlasRaster::sample(std::size_t index) const {
  TexelTile tile;
  tile.x = int(index) % columns_ * kTile;
  tile.y = int(index) / columns_ * kTile;
  tile.width = std::min(kTile, atlas_.width - tile.x);
  tile.height = std::min(kTile, atlas_.height - tile.y);
  std::size_t const texels = std::size_t(tile.width) * tile.height;
  Drawing drawing(texels, side_);
  for (std::uint32_t const face : tile_faces_[index]) {
    FlatFace const flat(atlas_, face);
    Range const columns = columns_of(flat, tile.x, tile.x + tile.width),
                rows = rows_of(flat, tile.y, tile.y + tile.height);
    for (int y = rows.low; y < rows.high; ++y)
      for (int x = columns.low; x < columns.high; ++x)
        drawing.draw(flat, face, V2d(x, y), std::size_t(y - tile.y) * tile.width + (x - tile.x));
  }
  tile.centres = std::move(drawing.centres);
  for (std::size_t t = 0; t < texels; ++t) {
    tile.first.push_back(std::uint32_t(tile.samples.size()));
    std::copy_if(drawing.samples.begin() + std::ptrdiff_t(t) * side_ * side_,
                 drawing.samples.begin() + std::ptrdiff_t(t + 1) * side_ * side_, std::back_inserter(tile.samples),
                 [](SurfacePoint const& sample) { return sample.face != kNoFace; });
    if (tile.samples.size() > tile.first.back())
      ++tile.covered;
    else if (drawing.distances[t] < kUnreached)
      tile.samples.push_back(tile.centres[t]);
  }
  tile.first.push_back(std::uint32_t(tile.samples.size()));
  return tile;
}

}  // namespace vitrine
