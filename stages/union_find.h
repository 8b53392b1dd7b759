// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Which items belong together, as pairs of them are joined.

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace vitrine {

/// Source: Galler & Fischer 1964, with path halving.
class UnionFind {
 public:
  explicit UnionFind(std::size_t n) : parent_(n), sets_(n) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  void join(std::size_t a, std::size_t b) {
    a = root(a), b = root(b);
    if (a == b) return;
    parent_[std::max(a, b)] = std::min(a, b);
    --sets_;
  }
  std::size_t sets() const { return sets_; }
  /// The first item of the set.
  std::size_t root(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

 private:
  std::vector<std::size_t> parent_;
  std::size_t sets_;
};

}  // namespace vitrine
