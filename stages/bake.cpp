// SPDX-License-Identifier: Apache-2.0
#include "stages/bake.h"

#include "stages/chart_tangents.h"
#include "stages/clean.h"
#include "stages/colour.h"
#include "stages/fill.h"
#include "stages/parallel.h"
#include "stages/plain_model.h"
#include "stages/quantize.h"
#include "stages/tangent_frame.h"
#include "stages/texel_matches.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vitrine {
namespace {

template <class Value>
std::array<Value, 3> corners(std::vector<Value> const& values, Triangle const& face) {
  return {values[face[0]], values[face[1]], values[face[2]]};
}

V3f face_normal(TriMesh const& mesh, std::uint32_t face) {
  auto const p = corners(mesh.positions, mesh.triangles[face]);
  return (p[1] - p[0]).cross(p[2] - p[0]).normalized();
}

std::vector<V3f> decoded_normals(TriMesh const& mesh, int bits) {
  std::vector<V3f> normals = smooth_normals(mesh);
  for (V3f& normal : normals) normal = quantize_normal(normal, bits);
  return normals;
}

/// What is baked, by texel, as the image will store it: sRGB and tangent space, in [0,1].
struct Layers {
  Layer colour, normal, derived_normal, occlusion;  // without channels if not wanted
  std::vector<std::uint8_t> known;                  // by texel
};

class Baker {
 public:
  Baker(QuantizedAtlas const& target, SurveyedModel const& original, BakeOptions const& options)
      : atlas_(target.atlas),
        mesh_(target.atlas.mesh),
        original_(original),
        side_(int(std::ceil(std::sqrt(double(options.samples))))),
        normals_(decoded_normals(mesh_, target.grid.normal_bits)),
        tangents_(chart_tangents(atlas_, normals_)),
        matcher_(atlas_, normals_, original, options, side_) {}

  std::vector<V3f> const& normals() const { return normals_; }
  std::vector<V3f> const& tangents() const { return tangents_; }

  BakeStatistics bake(Layers& layers) const {
    AtlasRaster const raster(atlas_, side_);
    return parallel_reduce(
        raster.tiles(), 1, BakeStatistics{},
        [&](std::size_t tile, std::size_t) { return bake_tile(raster.sample(tile), layers); },
        [](BakeStatistics total, BakeStatistics const& part) {
          total.texels += part.texels;
          total.samples += part.samples;
          total.misses += part.misses;
          return total;
        });
  }

 private:
  BakeStatistics bake_tile(TexelTile const& tile, Layers& layers) const {
    BakeStatistics statistics{tile.covered, tile.samples.size(), 0};
    std::vector<TexelMatch> const matches = matcher_.matches(tile.samples);
    for (std::size_t t = 0; t + 1 < tile.first.size(); ++t) {
      if (tile.first[t] == tile.first[t + 1]) continue;
      std::size_t const texel = (tile.y + t / tile.width) * atlas_.width + tile.x + t % tile.width;
      layers.known[texel] = 1;
      statistics.misses += bake_texel(tile, matches, t, texel, layers);
    }
    return statistics;
  }

  /// Returns the number of misses.
  std::uint64_t bake_texel(TexelTile const& tile, std::vector<TexelMatch> const& matches, std::size_t t,
                           std::size_t texel, Layers& layers) const {
    std::uint64_t misses = 0;
    Rgba sum{}, plain{};
    V3f normal(0);
    float seen = 0;
    std::uint32_t const begin = tile.first[t], end = tile.first[t + 1];
    for (std::uint32_t s = begin; s < end; ++s) {
      TexelMatch const& found = matches[s];
      misses += found.missed;
      SurfaceSample sample = original_.surface.sample(found.hit, matcher_.spacing(tile.samples[s].face));
      if (found.missed && face_normal(original_.model->mesh, found.hit.face).dot(found.side) < 0)
        sample.normal = -sample.normal;
      normal += sample.normal;
      for (int k = 0; k < 3; ++k) {
        sum[k] += sample.colour[k] * sample.colour[3];
        plain[k] += sample.colour[k];
      }
      sum[3] += sample.colour[3];
      if (layers.occlusion.channels > 0) seen += original_.occlusion->at(original_.model->mesh, found.hit);
    }
    float const count = float(end - begin);
    if (layers.colour.channels > 0) store_colour(sum, plain, count, layers.colour.at(texel));
    if (layers.normal.channels > 0) {
      V3f const drawn = matcher_.smooth_normal(tile.centres[t]),
                shown = normal.length2() > 0 ? normal.normalized() : drawn;
      std::uint32_t const face = tile.centres[t].face;
      store_normal(stored_frame(drawn, tangents_[atlas_.face_charts[face]]), shown, layers.normal.at(texel));
      if (layers.derived_normal.channels > 0)
        store_normal(client_frame(corners(mesh_.positions, mesh_.triangles[face]), atlas_.corner_uvs[face], drawn),
                     shown, layers.derived_normal.at(texel));
    }
    if (layers.occlusion.channels > 0) *layers.occlusion.at(texel) = seen / count;
    return misses;
  }

  static void store_colour(Rgba const& sum, Rgba const& plain, float count, float* texel) {
    for (int k = 0; k < 3; ++k) texel[k] = linear_to_srgb(sum[3] > 0 ? sum[k] / sum[3] : plain[k] / count);
    texel[3] = sum[3] / count;
  }

  static void store_normal(TangentFrame const& frame, V3f const& shown, float* texel) {
    V3f const m = to_tangent_space(frame, shown);
    for (int k = 0; k < 3; ++k) texel[k] = m[k] * 0.5f + 0.5f;
  }

  Atlas const& atlas_;
  TriMesh const& mesh_;
  SurveyedModel const& original_;
  int side_;
  std::vector<V3f> normals_;
  std::vector<V3f> tangents_;  // by chart
  TexelMatcher matcher_;
};

/// The first `channels` of the layer.
Image to_image(Layer const& layer, int channels, ColourSpace space) {
  Image image{layer.width, layer.height, channels, space, {}};
  std::size_t const texels = std::size_t(layer.width) * layer.height;
  image.texels.reserve(texels * channels);
  for (std::size_t t = 0; t < texels; ++t)
    for (int k = 0; k < channels; ++k) image.texels.push_back(to_byte(layer.at(t)[k]));
  return image;
}

Image grey_image(Layer const& layer) {
  Layer grey(layer.width, layer.height, 3);
  for (std::size_t i = 0; i < grey.values.size(); ++i) grey.values[i] = linear_to_srgb(layer.values[i / 3]);
  return to_image(grey, 3, ColourSpace::srgb);
}

bool all_opaque(Image const& image) {
  for (std::size_t i = 3; i < image.texels.size(); i += 4)
    if (image.texels[i] != 255) return false;
  return true;
}

void drop_alpha(Image& image) {
  std::size_t const texels = image.texels.size() / 4;
  for (std::size_t t = 0; t < texels; ++t)
    for (int k = 0; k < 3; ++k) image.texels[3 * t + k] = image.texels[4 * t + k];
  image.texels.resize(3 * texels);
  image.channels = 3;
}

Layers wanted_layers(Atlas const& atlas, SurveyedModel const& original, BakeOptions const& options) {
  auto const layer = [&](bool wanted, int channels) {
    return wanted ? Layer(atlas.width, atlas.height, channels) : Layer();
  };
  bool const normals = options.normal_map && !original.surface.unlit();
  return {layer(original.surface.coloured(), 4), layer(normals, 3), layer(normals && options.derived_normals, 3),
          layer(options.occlusion != Occlusion::none && original.occlusion.has_value(), 1),
          std::vector<std::uint8_t>(std::size_t(atlas.width) * atlas.height)};
}

void store_images(Layers const& layers, BakeOptions const& options, AlphaMode alpha, BakedModel& model) {
  if (layers.colour.channels > 0) {
    model.base_colour = {1, 1, 1, 1};
    model.colour = to_image(layers.colour, 4, ColourSpace::srgb);
    model.alpha = all_opaque(*model.colour) ? AlphaMode::opaque : alpha;
    if (model.alpha == AlphaMode::opaque) drop_alpha(*model.colour);
  }
  if (layers.normal.channels > 0) model.normal = to_image(layers.normal, 3, ColourSpace::linear);
  if (layers.derived_normal.channels > 0)
    model.derived_normal = to_image(layers.derived_normal, 3, ColourSpace::linear);
  if (layers.occlusion.channels > 0 && options.occlusion == Occlusion::occlusion)
    model.occlusion = to_image(layers.occlusion, 1, ColourSpace::linear);
  if (layers.occlusion.channels > 0 && options.occlusion == Occlusion::colour)
    model.colour = grey_image(layers.occlusion);
}

}  // namespace

BakedModel bake(QuantizedAtlas const& target, SurveyedModel const& original, BakeOptions const& options) {
  Baker const baker(target, original, options);
  BakedModel model = plain_model(target.atlas.mesh, target.grid, original);
  Layers layers = wanted_layers(target.atlas, original, options);
  bool const normal_map = layers.normal.channels > 0;
  if (normal_map || (options.vertex_normals && !model.unlit)) model.normals = baker.normals();
  if (normal_map) {
    model.face_charts = target.atlas.face_charts;
    model.chart_tangents = baker.tangents();
  }
  if (layers.colour.channels + layers.normal.channels + layers.occlusion.channels == 0) return model;
  model.corner_uvs = target.atlas.corner_uvs;
  model.statistics = baker.bake(layers);
  for (Layer* layer : {&layers.colour, &layers.normal, &layers.derived_normal, &layers.occlusion})
    if (layer->channels > 0) fill_unknown(*layer, layers.known);
  store_images(layers, options, original.surface.common_alpha(), model);
  return model;
}

}  // namespace vitrine
