// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Image files: reading by OpenImageIO, writing JPEG and PNG by OpenImageIO, WebP by libwebp (whose settings OpenImageIO does not reach).

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

/// Any common format (JPEG, PNG, WebP, TIFF, BMP, TGA, GIF …) to 8 bits, 1 to 4 channels; 16-bit and float images are converted.
/// Errors: InvalidInput for damaged or cut files; LimitExceeded when width x height exceeds limits.texels (checked before pixels are read).
Image decode_image(std::span<std::byte const> bytes, ColourSpace space, ReadLimits const& limits = {});

enum class ImageCodec { jpeg, png, webp };

struct ImageQuality {
  ImageCodec codec = ImageCodec::webp;
  int quality = 80;       ///< 1..100; PNG is lossless and ignores it
  bool full_chroma = false;  ///< JPEG: 4:4:4 instead of 4:2:0
};

/// The same bytes for the same image, on any thread. An image with alpha is never written as JPEG: PNG takes its place.
struct EncodedImage {
  std::string_view mime;  ///< "image/jpeg", "image/png", "image/webp"
  std::vector<std::byte> bytes;
};
EncodedImage encode_image(Image const& image, ImageQuality const& quality);

}  // namespace vitrine::io
