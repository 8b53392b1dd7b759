// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Image files: reading by OpenImageIO, writing PNG by OpenImageIO. JPEG is written by libjpeg, WebP by libwebp and
/// AVIF by libavif, whose settings OpenImageIO does not reach; WebP and AVIF are read by these, too.

#include "io/read_model.h"
#include "stages/data.h"

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace vitrine::io {

struct ImageSize {
  int width = 0, height = 0, channels = 0;
};

/// From the header alone. Errors: InvalidInput when it is no image that can be read.
ImageSize image_size(std::span<std::byte const> bytes);

/// Any common format (JPEG, PNG, WebP, AVIF, TIFF, BMP without run lengths, TGA, GIF …) to 8 bits, 1 to 4 channels;
/// 16-bit and float images are converted.
/// Errors: InvalidInput for damaged or cut files; LimitExceeded when width x height exceeds limits.texels (checked
///         before pixels are read).
Image decode_image(std::span<std::byte const> bytes, ColourSpace space, ReadLimits const& limits = {});

enum class ImageCodec { jpeg, png, webp, avif };

enum class Effort {
  usual,  ///< what image tools do unless told otherwise: baseline JPEG with optimised Huffman tables, WebP by method 4,
          ///< AVIF at speed 8; for many pictures
  thorough,  ///< progressive JPEG, WebP by method 6 with sharp chroma, AVIF at speed 6 in square blocks of 8 texels or more
  utmost  ///< AVIF of up to 2048 x 2048 texels at speed 5: five times as long for 7 % less error in as many bytes
};

struct ImageQuality {
  ImageCodec codec = ImageCodec::webp;
  int quality = 80;          ///< 1..100; PNG is lossless and ignores it. AVIF has 64 steps
  bool full_chroma = false;  ///< JPEG and AVIF: 4:4:4 instead of 4:2:0
  Effort effort = Effort::thorough;
};

/// Two qualities of which the codec makes the same bytes.
bool is_same_coding(ImageCodec codec, int quality, int other);

/// The same bytes for the same image, on any thread. An image with alpha is never written as JPEG: PNG takes its place.
struct EncodedImage {
  std::string_view mime;  ///< "image/jpeg", "image/png", "image/webp", "image/avif"
  std::vector<std::byte> bytes;
};
EncodedImage encode_image(Image const& image, ImageQuality const& quality);

}  // namespace vitrine::io
