// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Flattens charts.

#include "stages/data.h"

namespace vitrine {

/// Flattens each chart with least-squares conformal maps.
/// Source: Levy et al. 2002, "Least Squares Conformal Maps", section 3; pins: the two farthest boundary vertices.
/// In:     f faces, chart id per face; each chart a topological disk.
/// Out:    uv f x 3 x 2, chart-local, model units, orientation kept, each chart's area equal to its area in space; no
///         flipped triangle and no overlap within a chart (the map alone does not promise that: a chart that folds or
///         overlaps is split and retried, so c may grow). Never NaN.
/// Errors: InvalidInput, naming the chart, if it is no disk; NoSolution, naming the chart, if splitting does not help.
/// Cost:   O(n) memory, one sparse factorisation per chart; charts run in parallel.
FlatCharts parameterize(ChartedMesh const& charts);

}  // namespace vitrine
