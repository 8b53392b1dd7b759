// SPDX-License-Identifier: Apache-2.0
#include "io/image_codec.h"
#include "tests/support/bytes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numeric>

using namespace vitrine;
using namespace vitrine::io;
using testing::HasSubstr;

namespace {

/// Smooth in both directions, different in each channel.
Image waves(int width, int height, int channels) {
  Image image{width, height, channels, ColourSpace::srgb, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < channels; ++c)
        image.texels.push_back(static_cast<std::uint8_t>(128 + 100 * std::sin(0.05 * x + 0.03 * y + c)));
  return image;
}

double square_error(Image const& a, Image const& b) {
  auto const square = [](double x, double y) { return (x - y) * (x - y); };
  return std::transform_reduce(a.texels.begin(), a.texels.end(), b.texels.begin(), 0.0, std::plus(), square);
}

double worst_difference(Image const& a, Image const& b) {
  EXPECT_EQ(a.texels.size(), b.texels.size());
  int worst = 0;
  for (std::size_t i = 0; i < a.texels.size(); ++i) worst = std::max(worst, std::abs(a.texels[i] - b.texels[i]));
  return worst;
}

std::span<std::byte const> front(std::vector<std::byte> const& bytes, double share) {
  return std::span(bytes).first(static_cast<std::size_t>(static_cast<double>(bytes.size()) * share));
}

std::vector<std::byte> bytes_of(std::string_view text) {
  auto const* begin = reinterpret_cast<std::byte const*>(text.data());
  return {begin, begin + text.size()};
}

ErrorKind kind_of_failure(std::span<std::byte const> bytes, ReadLimits const& limits = {}) {
  try {
    decode_image(bytes, ColourSpace::srgb, limits);
  } catch (Error const& error) {
    return error.kind();
  }
  ADD_FAILURE() << "decoded";
  return ErrorKind::broken;
}

struct Codec {
  ImageCodec codec;
  int channels;
  double tolerance;
};
class EveryCodec : public testing::TestWithParam<Codec> {};

TEST_P(EveryCodec, GivesTheImageBack) {
  Image const image = waves(67, 45, GetParam().channels);
  EncodedImage const encoded = encode_image(image, {GetParam().codec, 95, true});
  Image const back = decode_image(encoded.bytes, ColourSpace::srgb);
  EXPECT_EQ(back.width, 67);
  EXPECT_EQ(back.height, 45);
  EXPECT_EQ(back.channels, GetParam().channels);
  EXPECT_LE(worst_difference(image, back), GetParam().tolerance);
}

TEST_P(EveryCodec, WritesTheSameBytesAgain) {
  Image const image = waves(67, 45, GetParam().channels);
  EXPECT_EQ(encode_image(image, {GetParam().codec, 80}).bytes, encode_image(image, {GetParam().codec, 80}).bytes);
}

TEST_P(EveryCodec, RefusesACutFile) {
  EncodedImage const encoded = encode_image(waves(67, 45, GetParam().channels), {GetParam().codec, 80});
  for (double share : {0.0, 0.01, 0.1, 0.5, 0.9})
    EXPECT_EQ(kind_of_failure(front(encoded.bytes, share)), ErrorKind::invalid_input) << share;
}

TEST_P(EveryCodec, RefusesMoreTexelsThanTheLimit) {
  EncodedImage const encoded = encode_image(waves(67, 45, GetParam().channels), {GetParam().codec, 80});
  ReadLimits limits;
  limits.texels = 67 * 45 - 1;
  EXPECT_EQ(kind_of_failure(encoded.bytes, limits), ErrorKind::limit_exceeded);
}

TEST_P(EveryCodec, TellsTheSizeFromTheHeader) {
  EncodedImage const encoded = encode_image(waves(67, 45, GetParam().channels), {GetParam().codec, 80});
  ImageSize const size = image_size(encoded.bytes);
  EXPECT_EQ(size.width, 67);
  EXPECT_EQ(size.height, 45);
  EXPECT_EQ(size.channels, GetParam().channels);
}

INSTANTIATE_TEST_SUITE_P(ImageCodec, EveryCodec,
                         testing::Values(Codec{ImageCodec::jpeg, 1, 6}, Codec{ImageCodec::jpeg, 3, 8},
                                         Codec{ImageCodec::png, 1, 0}, Codec{ImageCodec::png, 2, 0},
                                         Codec{ImageCodec::png, 3, 0}, Codec{ImageCodec::png, 4, 0},
                                         Codec{ImageCodec::webp, 3, 12}, Codec{ImageCodec::webp, 4, 12},
                                         Codec{ImageCodec::avif, 1, 6}, Codec{ImageCodec::avif, 2, 6},
                                         Codec{ImageCodec::avif, 3, 8}, Codec{ImageCodec::avif, 4, 8}));

TEST(ImageCodec, AlphaIsNeverWrittenAsJpeg) {
  EXPECT_EQ(encode_image(waves(8, 8, 4), {ImageCodec::jpeg, 90}).mime, "image/png");
  EXPECT_EQ(encode_image(waves(8, 8, 3), {ImageCodec::jpeg, 90}).mime, "image/jpeg");
}

TEST(ImageCodec, ColourBelowTransparentTexelsIsNotPremultiplied) {
  Image image{2, 1, 4, ColourSpace::srgb, {200, 100, 50, 10, 1, 2, 3, 0}};
  Image const back = decode_image(encode_image(image, {ImageCodec::png}).bytes, ColourSpace::srgb);
  EXPECT_EQ(back.texels, image.texels);
}

TEST(ImageCodec, SaysWhichColourSpaceTheCallerAskedFor) {
  EncodedImage const encoded = encode_image(waves(4, 4, 3), {ImageCodec::png});
  EXPECT_EQ(decode_image(encoded.bytes, ColourSpace::linear).space, ColourSpace::linear);
}

/// One texel wide, two high.
std::vector<std::byte> bitmap(int depth, int compression, std::initializer_list<std::uint32_t> words) {
  std::string bmp("BM", 2);
  auto const put = [&](std::uint32_t value, int bytes) {
    for (int k = 0; k < bytes; ++k) bmp.push_back(static_cast<char>(value >> 8 * k & 0xFF));
  };
  put(62, 4), put(0, 4), put(54, 4), put(40, 4), put(1, 4), put(2, 4), put(1, 2), put(std::uint32_t(depth), 2);
  put(std::uint32_t(compression), 4);
  for (int k = 0; k < 5; ++k) put(0, 4);
  for (std::uint32_t word : words) put(word, 4);
  return bytes_of(bmp);
}

TEST(ImageCodec, ReadsAWindowsBitmapWithTheTopRowFirst) {
  // Stored bottom up as B, G, R and a byte of padding: blue below, red above.
  Image const image = decode_image(bitmap(24, 0, {0x0000FF, 0xFF0000}), ColourSpace::srgb);
  EXPECT_THAT(image.texels, testing::ElementsAre(255, 0, 0, 0, 0, 255));
}

TEST(ImageCodec, RefusesRunLengthCodedBitmaps) {  // without a palette they end the process within the library
  for (int depth : {8, 24})
    for (int compression : {1, 2})
      EXPECT_EQ(kind_of_failure(bitmap(depth, compression, {0x0101, 0x0100})), ErrorKind::unsupported);
}

TEST(ImageCodec, SixteenBitsBecomeEight) {
  Image const image =
      decode_image(bytes_of(std::string_view("P5\n2 1\n65535\n\x80\x80\xFF\xFF", 17)), ColourSpace::srgb);
  EXPECT_THAT(image.texels, testing::ElementsAre(0x80, 0xFF));
}

TEST(ImageCodec, DoesNotBelieveASizeThatTheBytesCannotHold) {
  std::vector<std::byte> const bytes = bytes_of("P5\n30000 30000\n255\nabc");
  EXPECT_EQ(kind_of_failure(bytes), ErrorKind::invalid_input);
}

TEST(ImageCodec, NamesFormatsThatAreNotRead) {
  std::vector<std::byte> const heic =
      bytes_of(std::string_view("\0\0\0\x20"
                                "ftypheic\0\0\0\0",
                                16));
  EXPECT_EQ(kind_of_failure(heic), ErrorKind::unsupported);
  try {
    image_size(heic);
    FAIL();
  } catch (Error const& error) {
    EXPECT_THAT(error.what(), HasSubstr("HEIF"));
  }
}

double mean_square(Image const& a, Image const& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.texels.size(); ++i) sum += std::pow(double(a.texels[i]) - double(b.texels[i]), 2);
  return sum / double(a.texels.size());
}

/// Hard edges between colours of one brightness: what halved chroma cannot hold.
Image stripes() {
  Image image{64, 64, 3, ColourSpace::linear, {}};
  for (int i = 0; i < 64 * 64; ++i)
    for (int value : i % 2 == 0 ? std::array{200, 90, 120} : std::array{90, 148, 120})
      image.texels.push_back(static_cast<std::uint8_t>(value));
  return image;
}

TEST(ImageCodec, FullChromaKeepsWhatHalvedChromaBlurs) {
  Image const image = stripes();
  for (ImageCodec codec : {ImageCodec::jpeg, ImageCodec::avif}) {
    auto const error = [&](bool full) {
      return mean_square(image, decode_image(encode_image(image, {codec, 90, full}).bytes, ColourSpace::linear));
    };
    EXPECT_LT(error(true), error(false) / 4);
  }
}

TEST(ImageCodec, MoreQualityIsMoreBytesAndLessError) {
  Image const image = waves(67, 45, 3);
  for (ImageCodec codec : {ImageCodec::jpeg, ImageCodec::webp, ImageCodec::avif}) {
    EncodedImage const coarse = encode_image(image, {codec, 20, true}), fine = encode_image(image, {codec, 90, true});
    EXPECT_LT(coarse.bytes.size(), fine.bytes.size());
    EXPECT_GT(mean_square(image, decode_image(coarse.bytes, image.space)),
              mean_square(image, decode_image(fine.bytes, image.space)));
  }
}

TEST(ImageCodec, TheUsualEffortGivesTheImageBackToo) {
  Image const image = waves(67, 45, 3);
  for (ImageCodec codec : {ImageCodec::jpeg, ImageCodec::webp, ImageCodec::avif}) {
    EncodedImage const coded = encode_image(image, {codec, 95, true, Effort::usual});
    EXPECT_LE(worst_difference(image, decode_image(coded.bytes, image.space)), 12);
  }
}

/// Whether a JPEG has this marker segment before its first scan.
bool has_marker(std::vector<std::byte> const& jpeg, int marker) {
  for (std::size_t at = 2; at + 3 < jpeg.size() && jpeg[at] == std::byte{0xFF} && jpeg[at + 1] != std::byte{0xDA};
       at += 2 + (std::to_integer<std::size_t>(jpeg[at + 2]) << 8 | std::to_integer<std::size_t>(jpeg[at + 3])))
    if (jpeg[at + 1] == static_cast<std::byte>(marker)) return true;
  return false;
}

TEST(ImageCodec, JpegIsBaselineWithTheUsualEffortAndProgressiveWithMore) {
  constexpr int baseline = 0xC0, progressive = 0xC2;
  Image const image = waves(67, 45, 3);
  EXPECT_TRUE(has_marker(encode_image(image, {ImageCodec::jpeg, 90, true, Effort::usual}).bytes, baseline));
  EXPECT_TRUE(has_marker(encode_image(image, {ImageCodec::jpeg, 90, true, Effort::thorough}).bytes, progressive));
}

TEST(ImageCodec, AvifIsAsNearInFewerBytesWithMoreEffort) {
  Image const image = waves(200, 160, 3);
  EncodedImage const draft = encode_image(image, {ImageCodec::avif, 40, true, Effort::thorough}),
                     last = encode_image(image, {ImageCodec::avif, 40, true, Effort::utmost});
  EXPECT_LT(last.bytes.size(), draft.bytes.size());
  auto const error = [&](EncodedImage const& coded) {
    return square_error(image, decode_image(coded.bytes, image.space));
  };
  EXPECT_LT(error(last), 1.02 * error(draft));
}

TEST(ImageCodec, QualitiesOfOneCodingGiveTheSameBytes) {
  Image const image = waves(67, 45, 3);
  for (ImageCodec codec : {ImageCodec::jpeg, ImageCodec::webp, ImageCodec::avif, ImageCodec::png})
    for (int quality = 20; quality < 26; ++quality)
      EXPECT_EQ(is_same_coding(codec, quality, quality + 1),
                encode_image(image, {codec, quality}).bytes == encode_image(image, {codec, quality + 1}).bytes)
          << int(codec) << " " << quality;
}

TEST(ImageCodec, AvifKeepsAlphaWithoutLoss) {
  Image const image = waves(20, 20, 4);
  Image const back = decode_image(encode_image(image, {ImageCodec::avif, 30}).bytes, image.space);
  for (std::size_t i = 3; i < image.texels.size(); i += 4) ASSERT_EQ(image.texels[i], back.texels[i]) << i;
}

TEST(ImageCodec, AvifOfOneTexel) {
  Image const image{1, 1, 3, ColourSpace::srgb, {200, 100, 50}};
  EXPECT_LE(worst_difference(image, decode_image(encode_image(image, {ImageCodec::avif, 95, true}).bytes, image.space)),
            6);
}

TEST(ImageCodec, NamesAGitLfsPointer) {
  EXPECT_THAT(test::refusal([] {
                return image_size(bytes_of("version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1\n"));
              }),
              HasSubstr("the image is a Git-LFS pointer"));
}

}  // namespace
