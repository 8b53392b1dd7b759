// SPDX-License-Identifier: Apache-2.0
#include "stages/byte_model.h"

#include <algorithm>
#include <cmath>

namespace vitrine {
namespace {

/// A vertex for every two triangles, and all of its bits are noise beyond the first few.
constexpr double kBytesPerBit = 3.0 / 8 / 2;

constexpr double kBitsAtNone = 0.25, kBitsPerQuality = 0.009;  ///< of a texel

double expected_bytes_per_triangle(Recipe const& recipe) {
  double bytes = kBytesPerBit * (recipe.position_bits - 3.7);
  if (has_normals(recipe)) bytes += 0.06 * recipe.normal_bits + 0.1;
  if (recipe.painting == Painting::vertices) bytes += 0.1 * recipe.colour_bits - 0.15;
  if (recipe.painting == Painting::swatches) bytes += 0.2;
  if (is_textured(recipe)) bytes += 0.7;
  return bytes;
}

/// How many normals that takes is the original's own.
bool is_creased(Recipe const& recipe) { return recipe.shading == Shading::creased; }

double expected_map_bytes(Recipe const& recipe) {
  if (!is_textured(recipe)) return 0;
  return recipe.texture * double(recipe.texture) * expected_bytes_per_texel(recipe.map_quality);
}

/// In AVIF of what takes as many bytes in WebP, or the other way about: as it was for atlases of scans.
int other_quality(int quality, bool avif) {
  return int(std::clamp(avif ? 26 + 0.7 * quality : (quality - 26) / 0.7, double(kWorstQuality), double(kBestQuality)));
}

/// Of the logarithm of a map's bytes with its quality.
double rise(int quality, bool avif) { return (avif ? 2 : 1) * (0.05 - 0.009 * std::log(quality)); }

/// Where the logarithm of the bytes is so much higher.
int raised(int quality, double by, bool avif) {
  while (by > rise(quality, avif) / 2 && quality < kBestQuality) by -= rise(quality++, avif);
  while (by < -rise(quality, avif) / 2 && quality > kWorstQuality) by += rise(quality--, avif);
  return quality;
}

}  // namespace

double expected_bytes_per_texel(int map_quality) { return (kBitsAtNone + kBitsPerQuality * map_quality) / 8; }

int likely_quality(Recipe const& recipe, Trial const& like) {
  constexpr double kTexelPower = 0.5;  // with which bytes rise, at one quality
  constexpr int kFullChroma = -3;
  double const geometry = bytes_per_triangle(like) * relative_size(recipe, like.recipe) * recipe.triangles;
  double const room = std::max(1.0, recipe.ceiling - kHeaderBytes - geometry);
  double const texels = 2 * std::log(double(recipe.texture) / like.recipe.texture);
  double const more = std::log(room / double(std::max<std::size_t>(like.map_bytes, 1))) - kTexelPower * texels;
  int quality = like.recipe.avif == recipe.avif ? like.map_quality : other_quality(like.map_quality, recipe.avif);
  quality += kFullChroma * (int(recipe.full_chroma) - int(like.recipe.full_chroma));
  return raised(std::clamp(quality, kWorstQuality, kBestQuality), more, recipe.avif);
}

double bytes_per_triangle(Trial const& trial) {
  double const geometry = double(trial.bytes) - double(trial.map_bytes) - kHeaderBytes;
  return std::max(geometry / trial.recipe.triangles, expected_bytes_per_triangle(trial.recipe) / 2);
}

double relative_size(Recipe const& one, Recipe const& other) {
  return expected_bytes_per_triangle(one) / expected_bytes_per_triangle(other);
}

ByteModel::ByteModel(Recipe const& recipe, std::span<Trial const> history)
    : per_triangle_(expected_bytes_per_triangle(recipe)), map_(expected_map_bytes(recipe)) {
  bool alike = false;
  for (Trial const& trial : history) {
    if (trial.recipe.painting != recipe.painting || std::isinf(trial.error)) continue;
    bool const same = is_creased(trial.recipe) == is_creased(recipe);
    if (alike && !same) continue;
    alike = same;
    per_triangle_ = bytes_per_triangle(trial) * relative_size(recipe, trial.recipe);
    if (is_textured(recipe) && trial.map_bytes > 0)
      map_ = double(trial.map_bytes) * expected_map_bytes(recipe) / expected_map_bytes(trial.recipe);
  }
}

int ByteModel::triangles(double bytes) const { return triangles_beside(map_, bytes); }

int ByteModel::triangles_beside(double map_bytes, double bytes) const {
  return int(std::max(0.0, (bytes - kHeaderBytes - map_bytes) / per_triangle_));
}

}  // namespace vitrine
