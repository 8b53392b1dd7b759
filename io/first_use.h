// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Numbers distinct keys in the order of their first use. Internal to io.

#ifndef XXH_INLINE_ALL
#define XXH_INLINE_ALL
#endif
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
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

  std::uint32_t number(Key const& key) { return number(key, hash(key)); }

  /// Numbers of many keys at once, as many: the table's memory is asked for ahead, so that misses overlap.
  void number(std::span<Key const> keys, std::span<std::uint32_t> numbers) {
    constexpr std::size_t kAhead = 64;
    std::array<std::size_t, kAhead> hashes;
    for (std::size_t begin = 0; begin < keys.size(); begin += kAhead) {
      std::size_t const end = std::min(keys.size(), begin + kAhead);
      for (std::size_t i = begin; i < end; ++i) {
        hashes[i - begin] = hash(keys[i]);
        __builtin_prefetch(&slots_[hashes[i - begin] & (slots_.size() - 1)]);
      }
      for (std::size_t i = begin; i < end; ++i) numbers[i] = number(keys[i], hashes[i - begin]);
    }
  }

  /// By number.
  std::vector<Key> const& keys() const { return keys_; }

 private:
  static constexpr std::uint32_t kFree = std::numeric_limits<std::uint32_t>::max();

  static std::size_t hash(Key const& key) { return XXH3_64bits(&key, sizeof key); }

  std::size_t slot_of(Key const& key, std::size_t hash_of_key) const {
    std::size_t const mask = slots_.size() - 1;
    std::size_t slot = hash_of_key & mask;
    while (slots_[slot] != kFree && !(keys_[slots_[slot]] == key)) slot = (slot + 1) & mask;
    return slot;
  }

  std::uint32_t number(Key const& key, std::size_t hash_of_key) {
    std::uint32_t& slot = slots_[slot_of(key, hash_of_key)];
    if (slot != kFree) return slot;
    auto const created = static_cast<std::uint32_t>(keys_.size());
    slot = created;
    keys_.push_back(key);
    if (2 * keys_.size() > slots_.size()) grow();
    return created;
  }

  void grow() {
    slots_.assign(2 * slots_.size(), kFree);
    for (std::size_t i = 0; i < keys_.size(); ++i)
      slots_[slot_of(keys_[i], hash(keys_[i]))] = static_cast<std::uint32_t>(i);
  }

  std::vector<Key> keys_;
  std::vector<std::uint32_t> slots_;
};

}  // namespace vitrine::io
