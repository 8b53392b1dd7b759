// SPDX-License-Identifier: Apache-2.0
#include "stages/mip_map.h"

#include "stages/colour.h"
#include "stages/parallel.h"

#include <algorithm>
#include <cmath>

namespace vitrine {
namespace {

float mix(float a, float b, float weight) { return a + (b - a) * weight; }

/// Texels of one row or column that make up one of the next level, and the weight of the second.
struct Taps {
  int first = 0, second = 0;
  float weight = 0;
};

std::vector<Taps> halve(int size) {
  int const half = std::max(size / 2, 1);
  std::vector<Taps> taps;
  for (int i = 0; i < half; ++i) {
    float const place = (float(i) + 0.5f) * float(size) / float(half) - 0.5f;
    int const first = int(place);
    taps.push_back({first, std::min(first + 1, size - 1), place - float(first)});
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
        auto const value = [&](int row, int column) {
          std::uint8_t const byte = from.texels[(std::size_t(row) * from.width + column) * from.channels + channel];
          return gamma ? kLinearOfSrgb[byte] : float(byte) / 255;
        };
        auto const along = [&](int row) {
          return mix(value(row, columns[x].first), value(row, columns[x].second), columns[x].weight);
        };
        float const sum = mix(along(rows[y].first), along(rows[y].second), rows[y].weight);
        to.texels[(y * columns.size() + x) * from.channels + channel] = gamma ? to_srgb_byte(sum) : to_byte(sum);
      }
  });
  return to;
}

/// From here on floats have no useful fraction left; also what is not finite.
bool has_no_fraction(float at) { return !(std::abs(at) < 1e6f); }

/// Of such as have one: std::floor is a function call where the processor need not know SSE4.
float floor_below(float at) {
  float const whole = float(int(at));
  return whole > at ? whole - 1 : whole;
}

float wrap(float at, Wrap mode) {
  if (mode == Wrap::clamp) return at > 0 ? std::min(at, 1.f) : 0;
  if (has_no_fraction(at)) return 0;
  if (mode == Wrap::repeat) return at - floor_below(at);
  float const turn = at - 2 * floor_below(at / 2);
  return turn > 1 ? 2 - turn : turn;
}

/// Two neighbouring texels, or twice the same, of a row or column and the weight of the second.
struct Pair {
  int low, high;
  float weight;
};

Pair neighbours(float wrapped, int size, Wrap mode) {
  float const place = wrapped * float(size) - 0.5f;
  int const low = int(place + 1) - 1, last = size - 1, before = mode == Wrap::repeat ? last : 0;
  return {low < 0 ? before : low, low < last ? low + 1 : last - before, place - float(low)};
}

Pair nearest_to(float wrapped, int size) {
  int const at = std::min(int(wrapped * float(size)), size - 1);
  return {at, at, 0};
}

std::array<float, 256> const kShareOfByte = [] {
  std::array<float, 256> table;
  for (int i = 0; i < 256; ++i) table[i] = float(i) / 255;
  return table;
}();

/// Mean of four texels. `decoded`: what the bytes of the colour channels mean.
template <int kChannels>
Rgba bilinear(Image const& image, std::array<float, 256> const& decoded, Pair const& x, Pair const& y) {
  std::uint8_t const* const low = &image.texels[std::size_t(y.low) * image.width * kChannels];
  std::uint8_t const* const high = &image.texels[std::size_t(y.high) * image.width * kChannels];
  auto const channel = [&](int k, std::array<float, 256> const& values) {
    int const left = x.low * kChannels + k, right = x.high * kChannels + k;
    return mix(mix(values[low[left]], values[low[right]], x.weight),
               mix(values[high[left]], values[high[right]], x.weight), y.weight);
  };
  float const first = channel(0, decoded), alpha = kChannels % 2 == 0 ? channel(kChannels - 1, kShareOfByte) : 1;
  if constexpr (kChannels < 3)
    return {first, first, first, alpha};
  else
    return {first, channel(1, decoded), channel(2, decoded), alpha};
}

Rgba of_bytes(Image const& image, ColourSpace space, Pair const& x, Pair const& y) {
  std::array<float, 256> const& decoded = space == ColourSpace::srgb ? kLinearOfSrgb : kShareOfByte;
  switch (image.channels) {
    case 1:
      return bilinear<1>(image, decoded, x, y);
    case 2:
      return bilinear<2>(image, decoded, x, y);
    case 3:
      return bilinear<3>(image, decoded, x, y);
    default:
      return bilinear<4>(image, decoded, x, y);
  }
}

Rgba bilinear(std::vector<Rgba> const& texels, int width, Pair const& x, Pair const& y) {
  Rgba const* const low = &texels[std::size_t(y.low) * width];
  Rgba const* const high = &texels[std::size_t(y.high) * width];
  Rgba mean;
  for (std::size_t k = 0; k < 4; ++k)
    mean[k] =
        mix(mix(low[x.low][k], low[x.high][k], x.weight), mix(high[x.low][k], high[x.high][k], x.weight), y.weight);
  return mean;
}

/// Nothing if there are too many texels.
std::vector<Rgba> decode(Image const& image, ColourSpace space) {
  constexpr std::size_t most = 512 * 512;
  std::vector<Rgba> texels;
  if (std::size_t(image.width) * std::size_t(image.height) > most) return texels;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) texels.push_back(of_bytes(image, space, {x, x, 0}, {y, y, 0}));
  return texels;
}

}  // namespace

MipMap::MipMap(Image const& image, ColourSpace space) : base_(image), space_(space) {
  while (level_image(smaller_.size()).width > 1 || level_image(smaller_.size()).height > 1)
    smaller_.push_back(half_size(level_image(smaller_.size()), space));
  for (std::size_t level = 0; level <= smaller_.size(); ++level) decoded_.push_back(decode(level_image(level), space));
}

Rgba MipMap::sample_level(std::size_t level, V2f wrapped, TextureUse const& use, Filter filter) const {
  Image const& image = level_image(level);
  bool const nearest = filter == Filter::nearest;
  Pair const x = nearest ? nearest_to(wrapped.x, image.width) : neighbours(wrapped.x, image.width, use.wrap_u);
  Pair const y = nearest ? nearest_to(wrapped.y, image.height) : neighbours(wrapped.y, image.height, use.wrap_v);
  return decoded_[level].empty() ? of_bytes(image, space_, x, y) : bilinear(decoded_[level], image.width, x, y);
}

Rgba MipMap::sample(V2f uv, float level, TextureUse const& use) const {
  V2f const wrapped(wrap(uv.x, use.wrap_u), wrap(uv.y, use.wrap_v));
  Filter const filter = level > 0 ? use.minified : use.magnified;
  float const clamped = level > 0 ? std::min(level, float(smaller_.size())) : 0;
  std::size_t const finer = static_cast<std::size_t>(clamped);
  Rgba colour = sample_level(finer, wrapped, use, filter);
  float const weight = clamped - float(finer);
  if (weight == 0) return colour;
  Rgba const coarser = sample_level(finer + 1, wrapped, use, filter);
  for (int k = 0; k < 4; ++k) colour[k] = mix(colour[k], coarser[k], weight);
  return colour;
}

}  // namespace vitrine
