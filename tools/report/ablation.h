// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What each choice of the search is worth.

#include "tools/report/study.h"
#include "tools/report/table.h"

namespace vitrine::report {

/// For each choice that was left out: over the models that both could make, the geometric mean of how much larger the
/// error becomes, how much similarity is lost, how many models changed, and the one that it matters to most.
/// In: a study with an ablation.
Table ablation(Study const& study);

}  // namespace vitrine::report
