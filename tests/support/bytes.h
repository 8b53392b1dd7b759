// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Files made in memory, and what readers say of them.

#include "io/blob.h"
#include "stages/error.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vitrine::test {

/// Text and numbers of either byte order, one after the other.
class Bytes {
 public:
  explicit Bytes(std::endian order = std::endian::little) : order_(order) {}

  Bytes& text(std::string_view characters) {
    for (char c : characters) bytes_.push_back(static_cast<std::byte>(c));
    return *this;
  }
  template <class T, class... More>
  Bytes& put(T value, More... more) {
    std::byte raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    if (order_ != std::endian::native) std::reverse(raw, raw + sizeof(T));
    bytes_.insert(bytes_.end(), raw, raw + sizeof(T));
    (put(more), ...);
    return *this;
  }
  Bytes& cut(std::size_t bytes) {
    bytes_.resize(bytes_.size() - bytes);
    return *this;
  }
  io::Blob blob() const { return io::own(bytes_); }

 private:
  std::endian order_;
  std::vector<std::byte> bytes_;
};

inline io::Blob blob(std::string_view text) { return Bytes().text(text).blob(); }

/// A model that names nothing, or whose names lead nowhere.
inline std::optional<io::Blob> no_files(std::string_view) { return std::nullopt; }

/// What `read()` refuses, as "what; remedy"; "" when it does not.
template <class Read>
std::string refusal(Read const& read) {
  try {
    (void)read();
    return "";
  } catch (Error const& error) {
    return std::string(error.what()) + "; " + error.remedy();
  }
}

}  // namespace vitrine::test
