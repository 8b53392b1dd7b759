// SPDX-License-Identifier: Apache-2.0
#include "stages/swatches.h"

#include "stages/colour.h"
#include "stages/face_grid.h"
#include "stages/parallel.h"
#include "stages/quantize.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>

namespace vitrine {
namespace {

constexpr std::size_t kGrain = 1024;
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint64_t kNoVote = std::numeric_limits<std::uint64_t>::max();

/// Per channel of 8 bits.
bool within(float steps, V3f const& a, V3f const& b) {
  float const most = (steps + 0.5f) / 255;
  return std::abs(a.x - b.x) < most && std::abs(a.y - b.y) < most && std::abs(a.z - b.z) < most;
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

/// By face: the swatch that most samples show, or kNone.
std::vector<std::uint32_t> voted(TriMesh const& mesh, SurfaceSamples const& samples) {
  FaceGrid const grid(mesh, usual_reach(mesh));
  std::vector<std::uint64_t> votes(samples.points.size(), kNoVote);  // face, then swatch
  parallel_for(votes.size(), kGrain, [&](std::size_t s) {
    V4f const& colour = samples.colours[s];
    if (!(colour.w > 0)) return;
    if (auto const found = grid.closest(samples.points[s], samples.normals[s]))
      votes[s] = std::uint64_t(found->face) << 32 | nearest({colour.x, colour.y, colour.z}, samples.flat);
  });
  std::ranges::sort(votes);
  std::vector<std::uint32_t> swatches(mesh.triangles.size(), kNone), most(mesh.triangles.size(), 0);
  for (auto run = votes.begin(); run != votes.end() && *run != kNoVote;) {
    auto const end = std::upper_bound(run, votes.end(), *run);
    std::size_t const face = *run >> 32;
    if (auto const count = std::uint32_t(end - run); count > most[face])
      most[face] = count, swatches[face] = std::uint32_t(*run);
    run = end;
  }
  return swatches;
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
  constexpr double kNearlyAll = 0.995, kMostly = 0.9;
  std::size_t all = 0, kept = 0, exact = 0;
  std::vector<V3f> swatches;
  for (Counted const& one : counted(samples)) {
    all += one.samples;
    V3f const colour = unpacked(one.colour);
    auto const shows = [&](float steps) {
      return std::ranges::any_of(swatches, [&](V3f const& swatch) { return within(steps, swatch, colour); });
    };
    if (!shows(3) && one.samples >= kFew) swatches.push_back(colour);
    if (swatches.size() > kMost) return {};
    if (shows(3)) kept += one.samples;
    if (shows(1)) exact += one.samples;
  }
  if (double(kept) < kNearlyAll * double(all) || double(exact) < kMostly * double(all)) swatches.clear();
  return swatches;
}

Swatches make_swatches(TriMesh const& mesh, SurveyedModel const& original, SurfaceSamples const& samples) {
  std::size_t const many = samples.flat.size();
  Swatches made{picture(samples.flat), {}, 3};
  while (1 << made.uv_bits <= made.image.width) ++made.uv_bits;
  AxisCodes const codes(0, 1, made.uv_bits);
  std::vector<std::uint32_t> const chosen = voted(mesh, samples);
  made.uvs.resize(mesh.triangles.size());
  parallel_for(made.uvs.size(), kGrain, [&](std::size_t f) {
    auto const& [a, b, c] = mesh.triangles[f];
    V3f const middle = (mesh.positions[a] + mesh.positions[b] + mesh.positions[c]) / 3;
    std::size_t const swatch = chosen[f] != kNone ? chosen[f] : closest_to(middle, original, samples.flat);
    made.uvs[f] = {codes.value(codes.code((float(swatch) + 0.5f) / float(many))), codes.value(0)};
  });
  return made;
}

}  // namespace vitrine
