// SPDX-License-Identifier: Apache-2.0
#include "stages/fill.h"

#include <algorithm>
#include <cmath>

namespace vitrine {
namespace {

/// Of relaxation a level: two save 1 to 2 % of the bytes of WebP maps, more save nothing.
constexpr int kSweeps = 2;

/// Half the size; each texel the mean of the known ones among its four, known if any of them is.
Layer pull(Layer const& fine, std::vector<std::uint8_t> const& known, std::vector<std::uint8_t>& coarse_known) {
  Layer coarse((fine.width + 1) / 2, (fine.height + 1) / 2, fine.channels);
  std::vector<float> counts(std::size_t(coarse.width) * coarse.height);
  for (int y = 0; y < fine.height; ++y)
    for (int x = 0; x < fine.width; ++x) {
      std::size_t const from = std::size_t(y) * fine.width + x, to = std::size_t(y / 2) * coarse.width + x / 2;
      if (!known[from]) continue;
      counts[to] += 1;
      for (int k = 0; k < fine.channels; ++k) coarse.at(to)[k] += fine.at(from)[k];
    }
  coarse_known.resize(counts.size());
  for (std::size_t t = 0; t < counts.size(); ++t) {
    coarse_known[t] = counts[t] > 0;
    for (int k = 0; k < fine.channels && counts[t] > 0; ++k) coarse.at(t)[k] /= counts[t];
  }
  return coarse;
}

/// Two texels of the coarse row or column about a fine one, three quarters and one quarter.
struct Neighbours {
  int near, far;
  Neighbours(int fine, int coarse_size)
      : near(fine / 2), far(std::clamp(fine % 2 == 0 ? near - 1 : near + 1, 0, coarse_size - 1)) {}
};

/// Unknown texels take what bilinear lookup finds in the coarse layer.
void push(Layer& fine, std::vector<std::uint8_t> const& known, Layer const& coarse) {
  for (int y = 0; y < fine.height; ++y)
    for (int x = 0; x < fine.width; ++x) {
      std::size_t const texel = std::size_t(y) * fine.width + x;
      if (known[texel]) continue;
      Neighbours const column(x, coarse.width), row(y, coarse.height);
      auto const value = [&](int i, int j, int k) { return coarse.at(std::size_t(j) * coarse.width + i)[k]; };
      for (int k = 0; k < fine.channels; ++k)
        fine.at(texel)[k] = 0.5625f * value(column.near, row.near, k) + 0.1875f * value(column.far, row.near, k) +
                            0.1875f * value(column.near, row.far, k) + 0.0625f * value(column.far, row.far, k);
    }
}

/// Unknown texels move to the mean of their neighbours.
void relax(Layer& layer, std::vector<std::uint8_t> const& known) {
  for (int y = 0; y < layer.height; ++y)
    for (int x = 0; x < layer.width; ++x) {
      std::size_t const texel = std::size_t(y) * layer.width + x;
      if (known[texel]) continue;
      std::size_t const left = x > 0 ? texel - 1 : texel, right = x + 1 < layer.width ? texel + 1 : texel;
      std::size_t const above = y > 0 ? texel - layer.width : texel,
                        below = y + 1 < layer.height ? texel + layer.width : texel;
      for (int k = 0; k < layer.channels; ++k)
        layer.at(texel)[k] = 0.25f * (layer.at(left)[k] + layer.at(right)[k] + layer.at(above)[k] + layer.at(below)[k]);
    }
}

}  // namespace

void fill_unknown(Layer& layer, std::vector<std::uint8_t> const& known) {
  if (known.size() <= 1 || std::find(known.begin(), known.end(), 0) == known.end()) return;
  std::vector<std::uint8_t> coarse_known;
  Layer coarse = pull(layer, known, coarse_known);
  fill_unknown(coarse, coarse_known);
  push(layer, known, coarse);
  for (int i = 0; i < kSweeps; ++i) relax(layer, known);
}

}  // namespace vitrine
