// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The last trials of a search: as many triangles as the bytes allow, or as few as an error needs.

#include "stages/fit.h"

#include <optional>
#include <span>

namespace vitrine {

/// Measured on scans: near any number of bytes, error falls with their power.
inline constexpr double kErrorPower = 1.2;

struct Landing {
  double ceiling = 0;    ///< bytes
  double max_error = 0;  ///< MSE x 10^4
  int fewest = 0, most = 0;  ///< triangles
};

/// In:     trials, at least one, between which only the number of triangles differs.
/// Out:    what to try next between the largest file that fits and the smallest that does not; nothing once a file fills
///         the ceiling to 97 %, or where there is nothing in between.
std::optional<int> triangles_for_bytes(std::span<Trial const> like, Landing const& limits);

/// The same by the power law through the nearest trials; nothing once one is within 4 % of the error.
std::optional<int> triangles_for_error(std::span<Trial const> like, Landing const& limits);

}  // namespace vitrine
