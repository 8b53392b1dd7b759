// SPDX-License-Identifier: Apache-2.0
#include "stages/paint.h"

#include "stages/colour.h"
#include "stages/crease.h"
#include "stages/palette.h"
#include "stages/parallel.h"
#include "stages/plain_model.h"
#include "stages/swatches.h"
#include "stages/vertex_fit.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

namespace vitrine {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr std::size_t kGrain = 256;

/// With more than this off the palette's plane, as root of the mean square, hues are lost that one sees.
constexpr double kMostOffPalette = 0.03;

/// What the original shows closest to each vertex that `fit` has nothing for.
template <class Read>
std::vector<V3f> closest_to_unseen(VertexFit const& fit, TriMesh const& mesh, SurveyedModel const& original,
                                   Read const& read) {
  std::vector<V3f> values(mesh.positions.size(), V3f(0));
  parallel_for(values.size(), kGrain, [&](std::size_t v) {
    if (fit.seen()[v]) return;
    if (auto const hit = original.scene.closest_point(mesh.positions[v], kInfinity, {0, 0, 0}))
      values[v] = read(original.surface.sample(*hit, 0));
  });
  return values;
}

/// sRGB in [0,1].
std::vector<V3f> fitted_colours(TriMesh const& mesh, SurveyedModel const& original, SurfaceSamples const& samples,
                                double smoothing) {
  std::vector<V3f> values;
  std::vector<float> coverage;
  for (V4f const& c : samples.colours) {
    values.emplace_back(c.x, c.y, c.z);
    coverage.push_back(c.w);
  }
  VertexFit const fit(mesh, samples, coverage);
  std::vector<V3f> const unseen = closest_to_unseen(fit, mesh, original, [](SurfaceSample const& s) {
    return V3f(linear_to_srgb(s.colour[0]), linear_to_srgb(s.colour[1]), linear_to_srgb(s.colour[2]));
  });
  std::vector<V3f> colours = fit(values, unseen, smoothing);
  for (V3f& colour : colours)
    for (unsigned k = 0; k < 3; ++k) colour[k] = std::clamp(colour[k], 0.f, 1.f);
  return colours;
}

V3f linear(V3f const& srgb) { return {srgb_to_linear(srgb.x), srgb_to_linear(srgb.y), srgb_to_linear(srgb.z)}; }

/// Relative to the largest value of each channel, which becomes the base colour, and on the grid.
void store_colours(std::vector<V3f> const& srgb, BakedModel& model) {
  V3f most(0);
  for (V3f const& colour : srgb)
    for (unsigned k = 0; k < 3; ++k) most[k] = std::max(most[k], srgb_to_linear(colour[k]));
  AxisCodes const codes(0, 1, model.grid.colour_bits);
  for (V3f const& colour : srgb) {
    V3f const light = linear(colour);
    V3f& stored = model.colours.emplace_back(1.f);
    for (unsigned k = 0; k < 3; ++k)
      if (most[k] > 0) stored[k] = codes.value(codes.code(light[k] / most[k]));
  }
  bool const all_white =
      std::all_of(model.colours.begin(), model.colours.end(), [](V3f const& c) { return c == V3f(1); });
  if (all_white) model.colours.clear();
  model.base_colour = {most.x, most.y, most.z, 1};
  model.alpha = AlphaMode::opaque;
}

/// Colours that the model's corner_uvs pick.
void store_picture(Image picture, int uv_bits, BakedModel& model) {
  model.grid.uv_bits = uv_bits;
  model.colour = std::move(picture);
  model.palette = true;
  model.base_colour = {1, 1, 1, 1};
  model.alpha = AlphaMode::opaque;
}

void store_palette(Palette palette, BakedModel& model) {
  model.corner_uvs.reserve(model.mesh.triangles.size());
  for (auto const& [a, b, c] : model.mesh.triangles)
    model.corner_uvs.push_back({palette.uvs[a], palette.uvs[b], palette.uvs[c]});
  store_picture(std::move(palette.image), model.grid.colour_bits, model);
}

void store_swatches(Swatches swatches, BakedModel& model) {
  for (V2f const& uv : swatches.uvs) model.corner_uvs.push_back({uv, uv, uv});
  store_picture(std::move(swatches.image), swatches.uv_bits, model);
}

void store_fitted(TriMesh const& mesh, SurveyedModel const& original, SurfaceSamples const& samples,
                  PaintOptions const& options, BakedModel& model) {
  model.grid.colour_bits = options.colour_bits;
  std::vector<V3f> const colours = fitted_colours(mesh, original, samples, options.smoothing);
  std::optional<Palette> palette;
  if (options.palette) palette = make_palette(colours, options.colour_bits);
  if (palette && palette->off < kMostOffPalette)
    store_palette(*std::move(palette), model);
  else
    store_colours(colours, model);
}

void store_coverage(SurfaceSamples const& samples, SurveyedModel const& original, BakedModel& model) {
  if (original.surface.common_alpha() != AlphaMode::blend) return;
  double sum = 0;
  for (V4f const& colour : samples.colours) sum += colour.w;
  double const mean = sum / double(samples.colours.size());
  constexpr double kOpaque = 1 - 0.5 / 255;
  if (mean >= kOpaque) return;
  model.alpha = AlphaMode::blend;
  model.base_colour[3] = float(mean);
}

void part_at_creases(BakedModel& model, SurfaceSamples const& samples) {
  PartedMesh parted = part_at_creases(model.mesh, samples);
  std::vector<V3f> colours;
  if (!model.colours.empty())
    for (std::uint32_t v : parted.whole) colours.push_back(model.colours[v]);
  model.mesh = std::move(parted.mesh);
  model.colours = std::move(colours);
}

}  // namespace

void wear_normals(BakedModel& model, SurveyedModel const& original, SurfaceSamples const& samples,
                  PaintOptions const& options) {
  if (options.creases) part_at_creases(model, samples);
  VertexFit const fit(model.mesh, samples);
  std::vector<V3f> const unseen =
      closest_to_unseen(fit, model.mesh, original, [](SurfaceSample const& s) { return s.normal; });
  model.normals = fit(samples.shading, unseen, options.smoothing);
  for (V3f& normal : model.normals) normal = quantize_normal(normal, options.normal_bits);
  model.grid.normal_bits = options.normal_bits;
}

BakedModel paint(QuantizedMesh const& target, SurveyedModel const& original, SurfaceSamples const& samples,
                 PaintOptions const& options) {
  BakedModel model = plain_model(target.mesh, target.grid, original);
  if (original.surface.coloured()) {
    if (options.swatches && !samples.flat.empty())
      store_swatches(make_swatches(target.mesh, original, samples), model);
    else
      store_fitted(target.mesh, original, samples, options, model);
    store_coverage(samples, original, model);
  }
  if (options.normals && !model.unlit) wear_normals(model, original, samples, options);
  return model;
}

}  // namespace vitrine
