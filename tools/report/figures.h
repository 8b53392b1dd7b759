// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The charts of the paper's page.

#include "tools/report/chart.h"
#include "tools/report/study.h"

namespace vitrine::report {

/// Figure 4: what the bytes of each of the gallery's thumbnails are spent on.
Svg figure4(Study const& study);

/// The same for the paper's choices at each texture size, averaged over the models.
Svg figure4_by_texture(Study const& study);

/// Error over bytes of the geometric means over all models that every setting could make.
Svg curves_of_all(Study const& study);

/// Error over bytes of one model: thumbnails, and the series as rivals.
Svg curves_of(Study const& study, std::size_t model);

}  // namespace vitrine::report
