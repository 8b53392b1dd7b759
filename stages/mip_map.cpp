// SPDX-License-Identifier: Apache-2.0
#include "stages/mip_map.h"

#include "stages/colour.h"
#include "stages/parallel.h"

#include <algorithm>
#include <cmath>

namespace vitrine {
namespace {

/// Texels of one row or column that make up one of the next level, and their weights: two, or three of an odd number.
struct Taps {
  int first = 0, count = 1;
  std::array<float, 3> weights{1, 0, 0};
};

std::vector<Taps> halve(int size) {
  if (size == 1) return {Taps{}};
  std::vector<Taps> taps(static_cast<std::size_t>(size / 2));
  float const all = float(size), half = float(size / 2);
  for (int i = 0; i < size / 2; ++i) {
    taps[i].first = 2 * i;
    taps[i].count = 2 + size % 2;
    if (size % 2 == 0)
      taps[i].weights = {0.5f, 0.5f, 0};
    else
      taps[i].weights = {(half - float(i)) / all, half / all, float(i + 1) / all};
  }
  return taps;
}

bool is_alpha(Image const& image, int channel) { return image.channels % 2 == 0 && channel == image.channels - 1; }

/// Linear light to sRGB bytes, by a table fine enough for the darkest ones: a step there is 20 entries.
std::uint8_t to_srgb_byte(float linear) {
  static std::vector<std::uint8_t> const table = [] {
    std::vector<std::uint8_t> made(65536);
    for (std::size_t i = 0; i < made.size(); ++i) made[i] = to_byte(linear_to_srgb(float(i) / 65535));
    return made;
  }();
  return table[static_cast<std::size_t>(std::clamp(linear, 0.f, 1.f) * 65535 + 0.5f)];
}

Image half_size(Image const& from, ColourSpace space) {
  std::vector<Taps> const columns = halve(from.width), rows = halve(from.height);
  Image to{int(columns.size()), int(rows.size()), from.channels, space, {}};
  to.texels.resize(columns.size() * rows.size() * from.channels);
  parallel_for(rows.size(), 16, [&](std::size_t y) {
    for (std::size_t x = 0; x < columns.size(); ++x)
      for (int channel = 0; channel < from.channels; ++channel) {
        bool const gamma = space == ColourSpace::srgb && !is_alpha(from, channel);
        float sum = 0;
        for (int j = 0; j < rows[y].count; ++j)
          for (int i = 0; i < columns[x].count; ++i) {
            std::size_t const texel = std::size_t(rows[y].first + j) * from.width + columns[x].first + i;
            std::uint8_t const byte = from.texels[texel * from.channels + channel];
            sum += rows[y].weights[j] * columns[x].weights[i] * (gamma ? kLinearOfSrgb[byte] : float(byte) / 255);
          }
        to.texels[(y * columns.size() + x) * from.channels + channel] = gamma ? to_srgb_byte(sum) : to_byte(sum);
      }
  });
  return to;
}

/// From here on floats have no useful fraction left; also what is not finite.
bool has_no_fraction(float at) { return !(std::abs(at) < 1e6f); }

float wrap(float at, Wrap mode) {
  if (mode == Wrap::clamp) return at > 0 ? std::min(at, 1.f) : 0;
  if (has_no_fraction(at)) return 0;
  if (mode == Wrap::repeat) return at - std::floor(at);
  float const turn = at - 2 * std::floor(at / 2);
  return turn > 1 ? 2 - turn : turn;
}

/// Two neighbouring texels of a row or column and the weight of the second.
struct Pair {
  int low, high;
  float weight;
};

Pair neighbours(float at, int size, Wrap mode) {
  float const place = wrap(at, mode) * float(size) - 0.5f, floor = std::floor(place);
  int const low = int(floor);
  if (mode == Wrap::repeat) return {(low + size) % size, (low + 1) % size, place - floor};
  return {std::clamp(low, 0, size - 1), std::clamp(low + 1, 0, size - 1), place - floor};
}

Rgba mix(Rgba const& a, Rgba const& b, float weight) {
  Rgba mixed;
  for (int k = 0; k < 4; ++k) mixed[k] = a[k] + (b[k] - a[k]) * weight;
  return mixed;
}

Rgba fetch(Image const& image, ColourSpace space, int x, int y) {
  std::uint8_t const* const texel = &image.texels[(std::size_t(y) * image.width + x) * image.channels];
  auto const value = [&](int channel) {
    return space == ColourSpace::srgb ? kLinearOfSrgb[texel[channel]] : float(texel[channel]) / 255;
  };
  float const alpha = image.channels % 2 == 0 ? float(texel[image.channels - 1]) / 255 : 1;
  if (image.channels < 3) return {value(0), value(0), value(0), alpha};
  return {value(0), value(1), value(2), alpha};
}

}  // namespace

MipMap::MipMap(Image const& image, ColourSpace space) : base_(image), space_(space) {
  while (level_image(smaller_.size()).width > 1 || level_image(smaller_.size()).height > 1)
    smaller_.push_back(half_size(level_image(smaller_.size()), space));
}

Rgba MipMap::bilinear(Image const& image, V2f uv, Wrap wrap_u, Wrap wrap_v) const {
  Pair const x = neighbours(uv.x, image.width, wrap_u), y = neighbours(uv.y, image.height, wrap_v);
  return mix(mix(fetch(image, space_, x.low, y.low), fetch(image, space_, x.high, y.low), x.weight),
             mix(fetch(image, space_, x.low, y.high), fetch(image, space_, x.high, y.high), x.weight), y.weight);
}

Rgba MipMap::sample(V2f uv, float level, Wrap wrap_u, Wrap wrap_v) const {
  float const clamped = level > 0 ? std::min(level, float(smaller_.size())) : 0;
  std::size_t const finer = static_cast<std::size_t>(clamped);
  Rgba const colour = bilinear(level_image(finer), uv, wrap_u, wrap_v);
  float const weight = clamped - float(finer);
  if (weight == 0) return colour;
  return mix(colour, bilinear(level_image(finer + 1), uv, wrap_u, wrap_v), weight);
}

}  // namespace vitrine
