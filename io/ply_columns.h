// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the readers of PLY vertices and faces share. Internal to io.

#include "io/colour.h"
#include "io/ply_header.h"
#include "stages/data.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string_view>

namespace vitrine::io {

using PlyNames = std::initializer_list<std::string_view>;

template <std::size_t N>
using PlyColumns = std::array<std::size_t, N>;

/// The scalar properties under these names; nothing unless all are there.
template <std::size_t N>
std::optional<PlyColumns<N>> ply_columns(PlyElement const& element, std::array<PlyNames, N> const& names) {
  PlyColumns<N> columns{};
  for (std::size_t k = 0; k < N; ++k) {
    std::optional<std::size_t> const column = element.scalar(names[k]);
    if (!column) return std::nullopt;
    columns[k] = *column;
  }
  return columns;
}

/// Colours of vertices or faces: sRGB as bytes, 16 bits or 0..1, by the columns' type. Coverage is not kept: surfaces
/// are opaque.
struct PlyColour {
  PlyColumns<3> columns{};
  double full = 255;  ///< the value of full intensity

  /// Nothing unless the element has red, green and blue, under any of their usual names.
  static std::optional<PlyColour> of(PlyElement const& element);

  /// Of one record, of which `get(p)` gives property p; nothing when a value is not finite.
  template <class Get>
  std::optional<Rgba16> linear(Get const& get) const {
    Rgba16 rgba{0, 0, 0, 65535};
    for (std::size_t k = 0; k < 3; ++k) {
      double const value = get(columns[k]);
      if (!std::isfinite(value)) return std::nullopt;
      rgba[k] =
          full == 255 ? linear16(static_cast<std::uint8_t>(std::clamp(value, 0.0, 255.0))) : linear16(value / full);
    }
    return rgba;
  }
};

/// The smallest index at which something was wrong, whichever thread saw it first.
class FirstBad {
 public:
  void at(std::uint64_t index) {
    std::uint64_t known = index_.load(std::memory_order_relaxed);
    while (index < known && !index_.compare_exchange_weak(known, index, std::memory_order_relaxed)) continue;
  }
  std::optional<std::uint64_t> index() const {
    std::uint64_t const index = index_.load(std::memory_order_relaxed);
    return index == kNone ? std::nullopt : std::optional(index);
  }

 private:
  static constexpr std::uint64_t kNone = std::numeric_limits<std::uint64_t>::max();
  std::atomic<std::uint64_t> index_{kNone};
};

/// body(begin, end) over [0, n), in parallel; isolated, so that a waiting thread takes up no other model.
template <class Body>
void in_blocks(std::uint64_t n, Body const& body) {
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_for(tbb::blocked_range<std::uint64_t>(0, n, 8192),
                      [&](tbb::blocked_range<std::uint64_t> const& r) { body(r.begin(), r.end()); });
  });
}

}  // namespace vitrine::io
