// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/reader.h"

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  return vitrine::fuzz::read(vitrine::io::read_gltf, data, size);
}
