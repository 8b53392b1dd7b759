// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Figures 1 and 5: what models and their thumbnails look like.

#include "io/archive.h"
#include "tools/report/page.h"

namespace vitrine::report {

/// Renders and writes the pictures into GALLERY/paper/. An original or thumbnail that can no longer be read or drawn
/// leaves a gap, told on stderr. In: the originals, in the gallery's order.
Pictures publish_pictures(Study const& study, io::Archive const& archive);

/// Each face in the colour of its chart; neighbours among the numbers differ most.
SourceModel chart_coloured(ChartedMesh const& charts);

}  // namespace vitrine::report
