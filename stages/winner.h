// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Which of the trials so far is to be published. Internal to fit.

#include "stages/fit.h"

#include <cstddef>
#include <optional>
#include <span>

namespace vitrine {

inline bool are_smaller(Trial const& a, Trial const& b) { return a.bytes < b.bytes; }

/// Index of the best trial that keeps within the limits.
std::optional<std::size_t> best_within(Subject const& subject, FitOptions const& options,
                                       std::span<Trial const> history);

}  // namespace vitrine
