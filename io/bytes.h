// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Numbers in files of either byte order, at any address. Internal to io.

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>

namespace vitrine::io {

template <class T, std::endian Order = std::endian::little>
T load(std::byte const* at) {
  std::array<std::byte, sizeof(T)> bytes;
  std::memcpy(bytes.data(), at, sizeof(T));
  if constexpr (Order != std::endian::native) std::reverse(bytes.begin(), bytes.end());
  return std::bit_cast<T>(bytes);
}

}  // namespace vitrine::io
