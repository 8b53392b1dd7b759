// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A sample object as formulas, and the scan of it: any number of triangles of the same surface.

#include "tools/sample/grid.h"
#include "tools/sample/noise.h"

#include <functional>
#include <vector>

namespace vitrine::sample {

/// What the surface does at a place: how far it rises along its normal, and its colour (sRGB in 0..1).
struct Finish {
  double height = 0;
  V3d colour{0.7, 0.7, 0.7};
};

/// One connected surface. `normal` is only needed where `place` is dear or has folds; without it the tangents tell. The
/// outside is where v runs down, seen with u to the right.
struct Part {
  Topology topology;
  std::function<V3d(Uv const&)> place;                  ///< the smooth shape, in millimetres
  std::function<Finish(Uv const&, V3d const&)> finish;  ///< relief and paint, given also the smooth place
  std::function<V3d(V3d const&)> normal = {};           ///< of the smooth shape, outwards, unit
};

/// A part with its share of the triangles. Triangles have about the same size on all parts of an object.
struct PartGrid {
  Part part;
  Grid grid;
  std::uint32_t first_vertex, first_split;
  std::uint64_t first_triangle;
  std::uint32_t seed;
};

/// The scan: welded vertices with a colour each; triangles follow from the grids.
struct Scan {
  std::vector<PartGrid> parts;
  std::vector<V3f> positions;                        ///< n
  std::vector<std::array<std::uint8_t, 3>> colours;  ///< n, sRGB
  std::uint64_t triangles = 0;
  std::uint32_t split_vertices = 0;  ///< vertices when seams of the texture are cut
};

/// Samples the parts with about `triangles` (within a fifth, from some thousands on). Same scan for the same seed.
Scan scan(std::vector<Part> parts, std::uint64_t triangles, std::uint32_t seed);

/// Vertex indices of triangle `index`, below scan.triangles.
Triangle triangle(Scan const& scan, std::uint64_t index);
Triangle split_triangle(Scan const& scan, std::uint64_t index);

/// Of a split vertex: the welded one that it repeats, and its place in texture() of the same scan.
struct SplitVertex {
  std::uint32_t vertex;
  V2f uv;
};
SplitVertex split_vertex(Scan const& scan, std::uint32_t index);

/// The parts' paint as one image of width x width texels: each part a band over the whole width.
Image texture(Scan const& scan, int width);

}  // namespace vitrine::sample
