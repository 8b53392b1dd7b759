// SPDX-License-Identifier: Apache-2.0
#include "io/webp_animation.h"

#include "stages/error.h"

#include <gtest/gtest.h>
#include <webp/demux.h>

#include <cmath>
#include <memory>

namespace vitrine::io {
namespace {

/// A dark square that moves to the right.
Image frame(int step) {
  Image image{32, 32, 3, ColourSpace::srgb, std::vector<std::uint8_t>(3 * 32 * 32, 255)};
  for (int y = 8; y < 16; ++y)
    for (int x = 4 * step; x < 4 * step + 8; ++x)
      for (int k = 0; k < 3; ++k) image.texels[std::size_t(3 * (32 * y + x) + k)] = 40;
  return image;
}

std::vector<Image> const frames{frame(0), frame(2), frame(5)};

struct Shown {
  std::vector<int> until;  ///< milliseconds
  std::vector<std::vector<std::uint8_t>> rgba;
  WebPAnimInfo info{};
};

Shown play(std::vector<std::byte> const& bytes) {
  WebPData const data{reinterpret_cast<std::uint8_t const*>(bytes.data()), bytes.size()};
  std::unique_ptr<WebPAnimDecoder, decltype(&WebPAnimDecoderDelete)> const decoder(WebPAnimDecoderNew(&data, nullptr),
                                                                                   WebPAnimDecoderDelete);
  Shown shown;
  if (!decoder || !WebPAnimDecoderGetInfo(decoder.get(), &shown.info)) return shown;
  while (WebPAnimDecoderHasMoreFrames(decoder.get())) {
    std::uint8_t* pixels = nullptr;
    int until = 0;
    if (!WebPAnimDecoderGetNext(decoder.get(), &pixels, &until)) break;
    shown.until.push_back(until);
    shown.rgba.emplace_back(pixels, pixels + 4 * shown.info.canvas_width * shown.info.canvas_height);
  }
  return shown;
}

TEST(WebpAnimation, ShowsEachFrameForItsTimeForEver) {
  Shown const shown = play(encode_animation(frames, 90, 125));
  EXPECT_EQ(shown.until, (std::vector{125, 250, 375}));
  EXPECT_EQ(shown.info.loop_count, 0u);
  EXPECT_EQ(shown.info.canvas_width, 32u);
}

TEST(WebpAnimation, ShowsWhatWasGiven) {
  Shown const shown = play(encode_animation(frames, 90, 125));
  ASSERT_EQ(shown.rgba.size(), frames.size());
  for (std::size_t f = 0; f < frames.size(); ++f) {
    double sum = 0;
    for (std::size_t i = 0; i < 32 * 32; ++i)
      sum += std::abs(double(shown.rgba[f][4 * i]) - double(frames[f].texels[3 * i]));
    EXPECT_LT(sum / (32 * 32), 5) << f;
  }
}

TEST(WebpAnimation, WritesTheSameBytesAgain) {
  EXPECT_EQ(encode_animation(frames, 80, 100), encode_animation(frames, 80, 100));
}

TEST(WebpAnimation, OneFrameIsAnAnimationToo) {
  EXPECT_EQ(play(encode_animation({frame(1)}, 80, 100)).rgba.size(), 1u);
}

TEST(WebpAnimation, NothingIsNoAnimation) { EXPECT_THROW(encode_animation({}, 80, 100), Error); }

}  // namespace
}  // namespace vitrine::io
