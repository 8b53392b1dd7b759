// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Animated WebP by libwebp's own encoder of animations.

#include "stages/data.h"

#include <cstddef>
#include <vector>

namespace vitrine::io {

/// In:     at least one frame; all of one size, at most 16383 pixels a side, RGB or RGBA. quality 1..100.
/// Out:    an endless loop that shows each frame for so long; a frame is stored as what changed, where that is smaller.
///         The same bytes for the same frames, on any thread.
/// Errors: Broken, with libwebp's words.
std::vector<std::byte> encode_animation(std::vector<Image> const& frames, int quality, int milliseconds);

}  // namespace vitrine::io
