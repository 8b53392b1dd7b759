// SPDX-License-Identifier: Apache-2.0
#include "tests/support/pictures.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace vitrine::test {

Image empty_picture(int size) {
  Image picture{size, size, 4, ColourSpace::srgb, std::vector<std::uint8_t>(4u * size * size, 255)};
  for (std::size_t i = 3; i < picture.texels.size(); i += 4) picture.texels[i] = 0;
  return picture;
}

Image disk_picture(int size, double radius) {
  Image picture = empty_picture(size);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      if (std::hypot(x + 0.5 - size / 2.0, y + 0.5 - size / 2.0) > radius) continue;
      std::uint8_t* const texel = &picture.texels[4u * (y * size + x)];
      std::fill_n(texel, 3, static_cast<std::uint8_t>(200 - 100 * y / size));
      texel[3] = 255;
    }
  return picture;
}

Image noisy(Image picture, int most, unsigned seed) {
  std::mt19937 random(seed);
  for (std::size_t i = 0; i < picture.texels.size(); i += 4)
    for (std::size_t k = 0; k < 3; ++k) {
      int const step = int(random() % unsigned(2 * most + 1)) - most;
      if (picture.texels[i + 3] != 0)
        picture.texels[i + k] = static_cast<std::uint8_t>(std::clamp(picture.texels[i + k] + step, 0, 255));
    }
  return picture;
}

}  // namespace vitrine::test
