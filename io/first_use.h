// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Numbers distinct keys in the order of their first use. Internal to io.

#ifndef XXH_INLINE_ALL
#define XXH_INLINE_ALL
#endif
#include <xxhash.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

namespace vitrine::io {

/// Keys are equal when their bytes are. A hash table with linear probing, never more than half full; fewer than 2^32 -
/// 1 keys.
template <class Key>
class FirstUse {
  static_assert(std::has_unique_object_representations_v<Key>);

 public:
  explicit FirstUse(std::size_t expected = 0) : slots_(std::bit_ceil(2 * expected + 16), kFree) {
    keys_.reserve(expected);
  }

  std::uint32_t number(Key const& key) {
    std::uint32_t& slot = slots_[slot_of(key)];
    if (slot != kFree) return slot;
    auto const created = static_cast<std::uint32_t>(keys_.size());
    slot = created;
    keys_.push_back(key);
    if (2 * keys_.size() > slots_.size()) grow();
    return created;
  }

  /// By number.
  std::vector<Key> const& keys() const { return keys_; }

 private:
  static constexpr std::uint32_t kFree = std::numeric_limits<std::uint32_t>::max();

  std::size_t slot_of(Key const& key) const {
    std::size_t const mask = slots_.size() - 1;
    std::size_t slot = XXH3_64bits(&key, sizeof key) & mask;
    while (slots_[slot] != kFree && !(keys_[slots_[slot]] == key)) slot = (slot + 1) & mask;
    return slot;
  }

  void grow() {
    slots_.assign(2 * slots_.size(), kFree);
    for (std::size_t i = 0; i < keys_.size(); ++i) slots_[slot_of(keys_[i])] = static_cast<std::uint32_t>(i);
  }

  std::vector<Key> keys_;
  std::vector<std::uint32_t> slots_;
};

}  // namespace vitrine::io
