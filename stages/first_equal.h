// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Which items are equal, of many: by a hash table for each group of hashes, groups in parallel.

#include "stages/parallel.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace vitrine {

/// Of an item.
using Key = std::array<std::uint32_t, 3>;

namespace detail {

inline std::uint32_t hash(Key const& key) {
  std::uint64_t h = (key[0] | std::uint64_t{key[1]} << 32) * 0x9e3779b97f4a7c15u;
  h = ((h ^ h >> 32) + key[2]) * 0xd6e8feb86659fd93u;
  return static_cast<std::uint32_t>((h ^ h >> 32) * 0x9e3779b97f4a7c15u >> 32);
}

/// Items 0 to n - 1 grouped by the top bits of their hash, in order within each group.
struct Groups {
  std::vector<std::uint32_t> items, hashes;  ///< n
  std::vector<std::size_t> begins;           ///< per group, and the end
};

template <class KeyOf>
Groups group_by_hash(std::size_t n, KeyOf const& key_of) {
  std::size_t const items_per_group = std::size_t{1} << 17;  // whose table fits a core's cache
  int const bits = int(std::bit_width(n / items_per_group));
  auto group = [&](std::uint32_t h) { return std::size_t{std::uint64_t{h} << bits >> 32}; };

  Groups groups{std::vector<std::uint32_t>(n), std::vector<std::uint32_t>(n), {}};
  std::vector<std::size_t> ends((std::size_t{1} << bits) + 1);
  for (std::size_t i = 0; i < n; ++i) ++ends[group(hash(key_of(i))) + 1];
  for (std::size_t g = 1; g < ends.size(); ++g) ends[g] += ends[g - 1];
  groups.begins = ends;
  for (std::size_t i = 0; i < n; ++i) {
    std::uint32_t const h = hash(key_of(i));  // again: cheaper than a third array
    std::size_t const k = ends[group(h)]++;
    groups.items[k] = static_cast<std::uint32_t>(i);
    groups.hashes[k] = h;
  }
  return groups;
}

}  // namespace detail

/// For each of n items, below 2^32, the first one with the same key; key_of(i) -> Key.
template <class KeyOf>
std::vector<std::uint32_t> first_equal(std::size_t n, KeyOf const& key_of) {
  detail::Groups const groups = detail::group_by_hash(n, key_of);
  std::vector<std::uint32_t> const &items = groups.items, &hashes = groups.hashes;
  std::vector<std::size_t> const& begins = groups.begins;
  constexpr std::uint32_t kFree = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> first(n);
  parallel_for(begins.size() - 1, 1, [&](std::size_t g) {
    std::size_t const mask = std::bit_ceil(2 * (begins[g + 1] - begins[g]) + 1) - 1;
    std::vector<std::uint32_t> table(mask + 1, kFree);  // open addressing, at most half full
    for (std::size_t k = begins[g]; k < begins[g + 1]; ++k) {
      auto differs = [&](std::uint32_t other) {
        return hashes[other] != hashes[k] || key_of(items[other]) != key_of(items[k]);
      };
      std::size_t slot = hashes[k] & mask;
      while (table[slot] != kFree && differs(table[slot])) slot = (slot + 1) & mask;
      if (table[slot] == kFree) table[slot] = static_cast<std::uint32_t>(k);
      first[items[k]] = items[table[slot]];
    }
  });
  return first;
}

}  // namespace vitrine
