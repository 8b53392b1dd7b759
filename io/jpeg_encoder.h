// SPDX-License-Identifier: Apache-2.0
#pragma once
/// JPEG by libjpeg-turbo, whose optimised Huffman tables OpenImageIO does not reach. Internal to io.

#include "io/image_codec.h"

namespace vitrine::io {

/// In:     1 or 3 channels, at most 65500 texels a side.
/// Out:    JFIF and nothing beside it; Huffman tables are always optimised, scans progressive with Effort::thorough.
/// Errors: Broken, with libjpeg's words.
std::vector<std::byte> encode_jpeg(Image const& image, ImageQuality const& quality);

}  // namespace vitrine::io
