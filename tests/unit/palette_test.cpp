// SPDX-License-Identifier: Apache-2.0
#include "stages/palette.h"

#include "stages/colour.h"
#include "stages/mip_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace vitrine {
namespace {

/// What a client shows for each colour, in sRGB.
std::vector<V3f> shown(Palette const& palette) {
  MipMap const map(palette.image, ColourSpace::srgb);
  std::vector<V3f> colours;
  for (V2f const& uv : palette.uvs) {
    Rgba const c = map.sample(uv, 0, {});
    colours.emplace_back(linear_to_srgb(c[0]), linear_to_srgb(c[1]), linear_to_srgb(c[2]));
  }
  return colours;
}

float worst(std::vector<V3f> const& a, std::vector<V3f> const& b) {
  float most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, (a[i] - b[i]).length());
  return most;
}

std::vector<V3f> colours_in_a_plane() {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> unit(0, 1);
  std::vector<V3f> colours;
  for (int i = 0; i < 2000; ++i)
    colours.push_back(V3f(0.1f, 0.15f, 0.2f) + V3f(0.7f, 0.6f, 0.5f) * unit(random) +
                      V3f(0.15f, 0, -0.15f) * unit(random));
  return colours;
}

TEST(Palette, ShowsColoursOfAPlane) {
  std::vector<V3f> const colours = colours_in_a_plane();
  for (int bits = 3; bits <= 8; ++bits)
    EXPECT_LT(worst(shown(make_palette(colours, bits)), colours), 0.008f + 1.8f / float(1 << bits)) << bits;
}

TEST(Palette, StoresPlacesOfTheGridAwayFromTheEdge) {
  for (int bits : {3, 5, 8}) {
    Palette const palette = make_palette(colours_in_a_plane(), bits);
    float const last = float((1 << bits) - 1), half_texel = 0.5f / float(palette.image.width);
    for (V2f const& uv : palette.uvs)
      for (float place : {uv.x, uv.y}) {
        EXPECT_NEAR(place * last, std::round(place * last), 1e-4f);
        EXPECT_TRUE(place >= half_texel && place <= 1 - half_texel) << place;
      }
  }
}

TEST(Palette, GreysNeedButOneDirection) {
  std::vector<V3f> greys;
  for (int i = 0; i < 256; ++i) greys.push_back(V3f(float(i) / 255));
  Palette const palette = make_palette(greys, 6);
  for (V2f const& uv : palette.uvs) EXPECT_EQ(uv.y, palette.uvs[0].y);
  EXPECT_LT(worst(shown(palette), greys), 0.04f);
}

TEST(Palette, BrightnessRisesWithU) {
  Palette const palette = make_palette(colours_in_a_plane(), 5);
  EXPECT_LT(palette.image.texels[0], palette.image.texels[3 * std::size_t(palette.image.width - 1)]);
}

TEST(Palette, TakesASingleColour) {
  std::vector<V3f> const one(3, V3f(0.2f, 0.4f, 0.6f));
  EXPECT_LT(worst(shown(make_palette(one, 4)), one), 0.005f);
}

TEST(Palette, ColoursOffThePlaneKeepTheirShareInIt) {
  std::vector<V3f> colours = colours_in_a_plane();
  std::mt19937 random(2);
  std::uniform_real_distribution<float> off(-0.02f, 0.02f);
  V3f const normal = V3f(0.7f, 0.6f, 0.5f).cross(V3f(0.15f, 0, -0.15f)).normalized();
  for (V3f& c : colours) c += normal * off(random);
  EXPECT_LT(worst(shown(make_palette(colours, 8)), colours), 0.035f);
}

}  // namespace
}  // namespace vitrine
