// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The last trials of a search: as many triangles as the bytes allow, or as few as an error needs.

#include "stages/fit.h"

#include <optional>
#include <span>

namespace vitrine {

/// Measured on scans: near any number of bytes, error falls with their power.
inline constexpr double kErrorPower = 1.2;

/// Along what a search for an error lands: the bytes that a map fills, with which its area and the triangles grow; else
/// the triangles.
inline int extent(Recipe const& recipe) { return is_filled(recipe) ? recipe.ceiling : recipe.triangles; }

struct Landing {
  double ceiling = 0;       ///< bytes
  double max_error = 0;     ///< MSE x 10^4
  int least = 0, most = 0;  ///< triangles, or extents
};

/// In:     trials, at least one, between which only the number of triangles differs.
/// Out:    what to try next between the largest file that fits and the smallest that does not; nothing once a file
/// fills
///         the ceiling to 97 %, or where there is nothing in between.
std::optional<int> triangles_for_bytes(std::span<Trial const> like, Landing const& limits);

/// The same for trials that only their extent tells apart, by the power law through the nearest ones, later by
/// halves in turn with it; nothing once one is within 4 % of the error.
std::optional<int> extent_for_error(std::span<Trial const> like, Landing const& limits);

}  // namespace vitrine
