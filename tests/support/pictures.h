// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Pictures as `render` makes them: RGBA, an object on white, alpha its coverage.

#include "stages/data.h"

namespace vitrine::test {

/// Nothing but the white background.
Image empty_picture(int size);
/// A grey disk in the middle, lit from above.
Image disk_picture(int size, double radius);
/// The same with seeded noise of at most `most` byte steps on every colour channel of the object.
Image noisy(Image picture, int most, unsigned seed);

}  // namespace vitrine::test
