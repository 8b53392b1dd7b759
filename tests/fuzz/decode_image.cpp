// SPDX-License-Identifier: Apache-2.0
// An image decoder promises texels for its size within the limit, or an Error.
#include "io/image_codec.h"
#include "tests/fuzz/reader.h"

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  using namespace vitrine;
  io::ReadLimits limits;
  limits.texels = 1 << 20;
  try {
    Image const image = io::decode_image({reinterpret_cast<std::byte const*>(data), size}, ColourSpace::srgb, limits);
    fuzz::require(image.width > 0 && image.height > 0 && image.channels >= 1 && image.channels <= 4);
    std::size_t const texels = std::size_t(image.width) * std::size_t(image.height);
    fuzz::require(texels <= limits.texels && image.texels.size() == texels * std::size_t(image.channels));
  } catch (Error const& error) {
    fuzz::require(error.kind() != ErrorKind::broken);
  }
  return 0;
}
