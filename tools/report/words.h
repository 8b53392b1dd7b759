// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the figures say, in sentences.

#include "tools/report/study.h"

#include <string>
#include <vector>

namespace vitrine::report {

/// Plain text, one finding each. What cannot be said of these models (too few, nothing varies) is left out.
std::vector<std::string> findings(Study const& study);

}  // namespace vitrine::report
