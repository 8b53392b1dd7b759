// SPDX-License-Identifier: Apache-2.0
#pragma once
/// AVIF by libavif: libaom writes, dav1d reads, one thread each. Internal to io; io/image_codec.h is the way in.

#include "io/image_codec.h"

namespace vitrine::io {

/// Whether the bytes begin as AVIF files do, single images and sequences alike.
bool is_avif(std::span<std::byte const> bytes);

/// From the header alone. Errors: InvalidInput if it is damaged; Unsupported for turned or mirrored images.
ImageSize avif_size(std::span<std::byte const> bytes);

/// Of a sequence the still image. Errors: those of avif_size; LimitExceeded above limits.texels, before pixels are
/// read.
Image decode_avif(std::span<std::byte const> bytes, ColourSpace space, ReadLimits const& limits);

/// 0 (lossless) to 63, of a quality from 0 to 100.
int avif_quantiser(int quality);

/// 8 bits, full range, BT.601 as JPEG has it; grey as one plane; alpha without loss. The conversions are libavif's own:
/// those of libyuv round differently on different processors.
std::vector<std::byte> encode_avif(Image const& image, ImageQuality const& quality);

}  // namespace vitrine::io
