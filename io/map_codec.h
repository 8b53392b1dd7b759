// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Which coding a map gets.

#include "io/image_codec.h"
#include "stages/data.h"

namespace vitrine::io {

/// `map` in the coding asked for; or, where halved chroma makes up a third or more of that one's error (hard edges
/// between colours, fine relief in normals), as JPEG with full chroma, if that is nearer to `map` in no more bytes.
/// AVIF has full chroma of its own: it is written as asked for.
EncodedImage encode_map(Image const& map, ImageQuality const& quality);

/// The same for a map that is coded already.
EncodedImage nearer_coding(Image const& map, EncodedImage coded);

}  // namespace vitrine::io
