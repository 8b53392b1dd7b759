// SPDX-License-Identifier: Apache-2.0
#include "io/avif_codec.h"

#include <avif/avif.h>

#include <algorithm>
#include <memory>
#include <string>

namespace vitrine::io {
namespace {

using Bytes = std::span<std::byte const>;
using Decoder = std::unique_ptr<avifDecoder, decltype(&avifDecoderDestroy)>;

[[noreturn]] void refuse(ErrorKind kind, std::string const& what) {
  throw Error(kind, what, "supply the image as PNG or JPEG");
}

avifROData data_of(Bytes bytes) { return {reinterpret_cast<std::uint8_t const*>(bytes.data()), bytes.size()}; }

/// A decoder that has read the header: sizes are known, pixels are not.
Decoder parse(Bytes bytes, ReadLimits const& limits) {
  Decoder decoder(avifDecoderCreate(), avifDecoderDestroy);
  if (!decoder) throw std::bad_alloc();
  decoder->codecChoice = AVIF_CODEC_CHOICE_DAV1D;
  decoder->requestedSource = AVIF_DECODER_SOURCE_PRIMARY_ITEM;
  decoder->strictFlags = AVIF_STRICT_DISABLED;  // old writers leave boxes out that nothing here needs
  decoder->ignoreExif = decoder->ignoreXMP = AVIF_TRUE;
  decoder->imageSizeLimit = static_cast<std::uint32_t>(
      std::clamp<std::uint64_t>(limits.texels, 1, AVIF_DEFAULT_IMAGE_SIZE_LIMIT));  // libavif takes no more
  avifROData const data = data_of(bytes);
  avifResult result = avifDecoderSetIOMemory(decoder.get(), data.data, data.size);
  if (result == AVIF_RESULT_OK) result = avifDecoderParse(decoder.get());
  if (result != AVIF_RESULT_OK)
    refuse(ErrorKind::invalid_input, std::string("damaged AVIF image: ") + avifResultToString(result));
  if (decoder->image->transformFlags & (AVIF_TRANSFORM_IROT | AVIF_TRANSFORM_IMIR))
    refuse(ErrorKind::unsupported, "turned or mirrored AVIF images are not read");
  return decoder;
}

ImageSize size_of(avifDecoder const& decoder) {
  avifImage const& image = *decoder.image;
  int const colours = image.yuvFormat == AVIF_PIXEL_FORMAT_YUV400 ? 1 : 3;
  return {int(image.width), int(image.height), colours + (decoder.alphaPresent ? 1 : 0)};
}

/// Pixels as RGB or RGBA, whatever the image holds.
avifRGBImage rgb_view(avifImage const& image, bool alpha, std::vector<std::uint8_t>& texels) {
  avifRGBImage rgb;
  avifRGBImageSetDefaults(&rgb, &image);
  rgb.format = alpha ? AVIF_RGB_FORMAT_RGBA : AVIF_RGB_FORMAT_RGB;
  rgb.depth = 8;
  rgb.avoidLibYUV = AVIF_TRUE;
  rgb.chromaUpsampling = AVIF_CHROMA_UPSAMPLING_BEST_QUALITY;
  rgb.chromaDownsampling = AVIF_CHROMA_DOWNSAMPLING_BEST_QUALITY;
  rgb.rowBytes = image.width * (alpha ? 4 : 3);
  texels.resize(std::size_t(rgb.rowBytes) * image.height);
  rgb.pixels = texels.data();
  return rgb;
}

/// Every texel's channels, spread from grey or gathered to it: red stands for all three.
std::vector<std::uint8_t> with_channels(std::vector<std::uint8_t> const& texels, int from, int to) {
  if (from == to) return texels;
  auto const step = static_cast<std::size_t>(from);
  std::vector<std::uint8_t> out;
  out.reserve(texels.size() / step * static_cast<std::size_t>(to));
  for (std::size_t i = 0; i < texels.size(); i += step) {
    out.insert(out.end(), to >= 3 ? 3 : 1, texels[i]);
    if (to % 2 == 0) out.push_back(texels[i + step - 1]);
  }
  return out;
}

void require(avifResult result, Image const& image) {
  if (result != AVIF_RESULT_OK)
    throw Error(ErrorKind::broken,
                "libavif cannot encode " + std::to_string(image.width) + " x " + std::to_string(image.height) +
                    " texels: " + avifResultToString(result),
                "report this with the model");
}

/// Copies within the image, as of letters, are not looked for: that takes a seventh of the time and finds nothing in
/// maps.
void set_effort(avifEncoder& encoder, Image const& image, Effort effort) {
  constexpr std::int64_t kMany = 2048 * 2048;  // texels: more of them would take minutes at speed 5
  bool const many = std::int64_t(image.width) * image.height > kMany;
  encoder.speed = effort == Effort::usual ? 8 : effort == Effort::thorough || many ? 6 : 5;
  if (effort == Effort::usual) return;
  avifEncoderSetCodecSpecificOption(&encoder, "enable-intrabc", "0");
  if (effort == Effort::utmost) return;
  avifEncoderSetCodecSpecificOption(&encoder, "enable-rect-partitions", "0");
  avifEncoderSetCodecSpecificOption(&encoder, "min-partition-size", "8");
}

/// Constant quality: the quantiser is a start, and libaom may leave it where that pays.
void set_quality(avifEncoder& encoder, ImageQuality const& quality) {
  int const quantiser = avif_quantiser(quality.quality);
  encoder.minQuantizer = AVIF_QUANTIZER_BEST_QUALITY;
  encoder.maxQuantizer = AVIF_QUANTIZER_WORST_QUALITY;
  encoder.minQuantizerAlpha = encoder.maxQuantizerAlpha = AVIF_QUANTIZER_LOSSLESS;
  avifEncoderSetCodecSpecificOption(&encoder, "end-usage", "q");
  avifEncoderSetCodecSpecificOption(&encoder, "color:cq-level", std::to_string(quantiser).c_str());
  avifEncoderSetCodecSpecificOption(&encoder, "alpha:cq-level", "0");
}

}  // namespace

bool is_avif(Bytes bytes) {
  avifROData const data = data_of(bytes);
  return avifPeekCompatibleFileType(&data);
}

int avif_quantiser(int quality) {
  return ((100 - std::clamp(quality, 0, 100)) * AVIF_QUANTIZER_WORST_QUALITY + 50) / 100;
}

ImageSize avif_size(Bytes bytes) { return size_of(*parse(bytes, {})); }

Image decode_avif(Bytes bytes, ColourSpace space, ReadLimits const& limits) {
  ImageSize const size = avif_size(bytes);
  std::uint64_t const texels = std::uint64_t(size.width) * std::uint64_t(size.height);
  if (texels > limits.texels)
    throw Error(ErrorKind::limit_exceeded,
                "image of " + std::to_string(size.width) + " x " + std::to_string(size.height) + " = " +
                    std::to_string(texels) + " texels; the limit is " + std::to_string(limits.texels),
                "supply a smaller image");
  Decoder const decoder = parse(bytes, limits);
  avifResult result = avifDecoderNextImage(decoder.get());
  Image image{size.width, size.height, size.channels, space, {}};
  if (result == AVIF_RESULT_OK) {
    std::vector<std::uint8_t> texels_rgb;
    avifRGBImage rgb = rgb_view(*decoder->image, size.channels % 2 == 0, texels_rgb);
    result = avifImageYUVToRGB(decoder->image, &rgb);
    image.texels = with_channels(texels_rgb, size.channels % 2 == 0 ? 4 : 3, size.channels);
  }
  if (result != AVIF_RESULT_OK)
    refuse(ErrorKind::invalid_input, std::string("damaged AVIF image: ") + avifResultToString(result));
  return image;
}

std::vector<std::byte> encode_avif(Image const& image, ImageQuality const& quality) {
  bool const grey = image.channels <= 2, alpha = image.channels % 2 == 0;
  avifPixelFormat const format = grey                  ? AVIF_PIXEL_FORMAT_YUV400
                                 : quality.full_chroma ? AVIF_PIXEL_FORMAT_YUV444
                                                       : AVIF_PIXEL_FORMAT_YUV420;
  std::unique_ptr<avifImage, decltype(&avifImageDestroy)> const coded(
      avifImageCreate(std::uint32_t(image.width), std::uint32_t(image.height), 8, format), avifImageDestroy);
  std::unique_ptr<avifEncoder, decltype(&avifEncoderDestroy)> const encoder(avifEncoderCreate(), avifEncoderDestroy);
  if (!coded || !encoder) throw std::bad_alloc();
  coded->colorPrimaries = AVIF_COLOR_PRIMARIES_BT709;
  coded->transferCharacteristics = AVIF_TRANSFER_CHARACTERISTICS_SRGB;
  coded->matrixCoefficients = AVIF_MATRIX_COEFFICIENTS_BT601;
  std::vector<std::uint8_t> texels;
  avifRGBImage rgb = rgb_view(*coded, alpha, texels);
  texels = with_channels(image.texels, image.channels, alpha ? 4 : 3);
  rgb.pixels = texels.data();
  require(avifImageRGBToYUV(coded.get(), &rgb), image);

  encoder->codecChoice = AVIF_CODEC_CHOICE_AOM;
  encoder->maxThreads = 1;
  set_effort(*encoder, image, quality.effort);
  set_quality(*encoder, quality);
  avifRWData output = AVIF_DATA_EMPTY;
  avifResult const result = avifEncoderWrite(encoder.get(), coded.get(), &output);
  std::unique_ptr<avifRWData, decltype(&avifRWDataFree)> const freed(&output, avifRWDataFree);
  require(result, image);
  auto const* begin = reinterpret_cast<std::byte const*>(output.data);
  return {begin, begin + output.size};
}

}  // namespace vitrine::io
