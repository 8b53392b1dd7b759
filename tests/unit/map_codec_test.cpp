// SPDX-License-Identifier: Apache-2.0
#include "io/map_codec.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vitrine::io {
namespace {

/// Red, green, blue and grey patches of 13 x 13 texels: edges of pure chroma across blocks of every codec.
Image patches() {
  Image image{64, 64, 3, ColourSpace::srgb, {}};
  constexpr std::uint8_t palette[4][3] = {{230, 30, 30}, {20, 120, 20}, {60, 60, 250}, {100, 100, 100}};
  for (int i = 0; i < 64 * 64; ++i) {
    auto const& colour = palette[(i % 64 / 13 + 3 * (i / 64 / 13)) % 4];
    image.texels.insert(image.texels.end(), colour, colour + 3);
  }
  return image;
}

/// Grey waves: no chroma at all.
Image waves(int channels) {
  Image image{64, 64, channels, ColourSpace::srgb, {}};
  for (int i = 0; i < 64 * 64; ++i)
    image.texels.insert(image.texels.end(), static_cast<std::size_t>(channels),
                        static_cast<std::uint8_t>(127 + 100 * std::sin(i % 64 / 3.0) * std::cos(i / 64 / 5.0)));
  return image;
}

double error(Image const& map, EncodedImage const& coded) {
  Image const decoded = decode_image(coded.bytes, map.space);
  double sum = 0;
  for (std::size_t i = 0; i < map.texels.size(); ++i) sum += std::pow(double(map.texels[i]) - decoded.texels[i], 2);
  return sum / double(map.texels.size());
}

TEST(EncodeMap, KeepsTheCodingAskedForWhereChromaIsSmooth) {
  for (ImageCodec codec : {ImageCodec::webp, ImageCodec::jpeg}) {
    ImageQuality const quality{codec, 60};
    EXPECT_EQ(encode_map(waves(3), quality).bytes, encode_image(waves(3), quality).bytes);
  }
}

TEST(EncodeMap, TakesFullChromaWhereHardColourEdgesNeedIt) {
  for (ImageCodec codec : {ImageCodec::webp, ImageCodec::jpeg}) {
    ImageQuality const quality{codec, 90};
    EncodedImage const plain = encode_image(patches(), quality), chosen = encode_map(patches(), quality);
    EXPECT_EQ(chosen.mime, "image/jpeg");
    EXPECT_LE(chosen.bytes.size(), plain.bytes.size());
    EXPECT_LT(error(patches(), chosen), error(patches(), plain));
  }
}

TEST(EncodeMap, LeavesGreyAlphaAndPngAlone) {
  EXPECT_EQ(encode_map(waves(1), {ImageCodec::webp, 60}).mime, "image/webp");
  EXPECT_EQ(encode_map(waves(4), {ImageCodec::webp, 60}).mime, "image/webp");
  EXPECT_EQ(encode_map(patches(), {ImageCodec::png}).mime, "image/png");
}

}  // namespace
}  // namespace vitrine::io
