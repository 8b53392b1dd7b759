// SPDX-License-Identifier: Apache-2.0
#include "stages/swatches.h"

#include "stages/colour.h"
#include "stages/face_grid.h"
#include "stages/parallel.h"
#include "stages/quantize.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace vitrine {
namespace {

constexpr std::size_t kGrain = 1024;
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr float kSame = 3.5f / 255;  ///< per channel

bool is_same(V3f const& a, V3f const& b) {
  return std::abs(a.x - b.x) < kSame && std::abs(a.y - b.y) < kSame && std::abs(a.z - b.z) < kSame;
}

struct Counted {
  std::uint32_t colour;  ///< 8 bits a channel
  std::size_t samples;
};

/// The commonest first.
std::vector<Counted> counted(SurfaceSamples const& samples) {
  std::vector<std::uint32_t> all;
  for (V4f const& c : samples.colours)
    if (c.w > 0) all.push_back(std::uint32_t(to_byte(c.x)) << 16 | std::uint32_t(to_byte(c.y)) << 8 | to_byte(c.z));
  std::ranges::sort(all);
  std::vector<Counted> found;
  for (std::uint32_t const colour : all) {
    if (found.empty() || found.back().colour != colour) found.push_back({colour, 0});
    ++found.back().samples;
  }
  std::ranges::stable_sort(found, std::greater{}, &Counted::samples);
  return found;
}

V3f unpacked(std::uint32_t colour) {
  return V3f(float(colour >> 16), float(colour >> 8 & 255), float(colour & 255)) / 255;
}

std::size_t nearest(V3f const& colour, std::vector<V3f> const& swatches) {
  auto const distance = [&](V3f const& swatch) { return (swatch - colour).length2(); };
  return std::size_t(std::ranges::min_element(swatches, {}, distance) - swatches.begin());
}

/// By face and swatch: how many samples.
std::vector<std::uint32_t> votes(TriMesh const& mesh, SurfaceSamples const& samples) {
  FaceGrid const grid(mesh, usual_reach(mesh));
  std::vector<std::uint32_t> slots(samples.points.size(), kNone);
  parallel_for(slots.size(), kGrain, [&](std::size_t s) {
    V4f const& colour = samples.colours[s];
    if (!(colour.w > 0)) return;
    if (auto const found = grid.closest(samples.points[s], samples.normals[s]))
      slots[s] =
          std::uint32_t(found->face * samples.flat.size() + nearest({colour.x, colour.y, colour.z}, samples.flat));
  });
  std::vector<std::uint32_t> counts(mesh.triangles.size() * samples.flat.size(), 0);
  for (std::uint32_t const slot : slots)
    if (slot != kNone) ++counts[slot];
  return counts;
}

std::size_t closest_to(V3f const& place, SurveyedModel const& original, std::vector<V3f> const& swatches) {
  auto const hit = original.scene.closest_point(place, std::numeric_limits<float>::infinity(), {0, 0, 0});
  if (!hit) return 0;
  Rgba const c = original.surface.sample(*hit, 0).colour;
  return nearest({linear_to_srgb(c[0]), linear_to_srgb(c[1]), linear_to_srgb(c[2])}, swatches);
}

Image picture(std::vector<V3f> const& swatches) {
  Image image{int(2 * swatches.size()), 1, 3, ColourSpace::srgb, {}};
  for (V3f const& colour : swatches)
    for (int twice = 0; twice < 2; ++twice)
      for (unsigned k = 0; k < 3; ++k) image.texels.push_back(to_byte(colour[k]));
  return image;
}

}  // namespace

std::vector<V3f> flat_colours(SurfaceSamples const& samples) {
  constexpr std::size_t kMost = 64, kFew = 8;
  constexpr double kNearlyAll = 0.995;
  std::size_t all = 0, kept = 0;
  std::vector<V3f> swatches;
  for (Counted const& one : counted(samples)) {
    all += one.samples;
    V3f const colour = unpacked(one.colour);
    bool const known = std::ranges::any_of(swatches, [&](V3f const& swatch) { return is_same(swatch, colour); });
    if (!known && one.samples < kFew) continue;
    if (!known) swatches.push_back(colour);
    if (swatches.size() > kMost) return {};
    kept += one.samples;
  }
  if (double(kept) < kNearlyAll * double(all)) swatches.clear();
  return swatches;
}

Swatches make_swatches(TriMesh const& mesh, SurveyedModel const& original, SurfaceSamples const& samples) {
  std::size_t const many = samples.flat.size();
  Swatches made{picture(samples.flat), {}, 3};
  while (1 << made.uv_bits <= made.image.width) ++made.uv_bits;
  AxisCodes const codes(0, 1, made.uv_bits);
  std::vector<std::uint32_t> const counts = votes(mesh, samples);
  made.uvs.resize(mesh.triangles.size());
  parallel_for(made.uvs.size(), kGrain, [&](std::size_t f) {
    auto const first = counts.begin() + std::ptrdiff_t(f * many), most = std::max_element(first, first + many);
    auto const& [a, b, c] = mesh.triangles[f];
    std::size_t const swatch =
        *most > 0 ? std::size_t(most - first)
                  : closest_to((mesh.positions[a] + mesh.positions[b] + mesh.positions[c]) / 3, original, samples.flat);
    made.uvs[f] = {codes.value(codes.code((float(swatch) + 0.5f) / float(many))), codes.value(0)};
  });
  return made;
}

}  // namespace vitrine
