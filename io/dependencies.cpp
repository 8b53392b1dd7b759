// SPDX-License-Identifier: Apache-2.0
#include "io/dependencies.h"

#include <xxhash.h>

#include <array>
#include <utility>

namespace vitrine::io {

std::string content_hash(std::span<std::byte const> bytes) {
  XXH128_canonical_t canonical;
  XXH128_canonicalFromHash(&canonical, XXH3_128bits(bytes.data(), bytes.size()));
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (unsigned char byte : canonical.digest) {
    text += kDigits[byte >> 4];
    text += kDigits[byte & 15];
  }
  return text;
}

Resolve recording(Resolve resolve, Dependencies& found) {
  return [resolve = std::move(resolve), &found](std::string_view reference) {
    std::optional<Blob> file = resolve(reference);
    found.insert_or_assign(std::string(reference), file ? content_hash(file->bytes) : std::string());
    return file;
  };
}

}  // namespace vitrine::io
