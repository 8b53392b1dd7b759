// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Pictures of any shape as frames of a series: squares of one size.

#include "stages/data.h"

namespace vitrine {

/// In:     an sRGB picture of 1 to 4 channels, at least one texel.
/// Out:    RGB, size x size: the whole picture on white, in the middle, reduced where it is larger (never enlarged):
///         each texel is the mean of the byte values below it, as for `render`. What is transparent shows white.
Image letterbox(Image const& picture, int size);

}  // namespace vitrine
