// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Which of the trials so far is to be published. Internal to fit.

#include "stages/fit.h"

#include <cstddef>
#include <optional>
#include <span>

namespace vitrine {

/// Index of the best trial that keeps within the limits.
std::optional<std::size_t> best_within(Subject const& subject, FitOptions const& options,
                                       std::span<Trial const> history);

/// The smallest file so far with less of everything, as long as none keeps to the ceiling: not even a map's poorest
/// quality makes up for too many triangles. Nothing once that was tried.
std::optional<Recipe> shrunk(Subject const& subject, FitOptions const& options, std::span<Trial const> history);

}  // namespace vitrine
