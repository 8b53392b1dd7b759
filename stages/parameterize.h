// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Flattens charts.

#include "stages/data.h"

namespace vitrine {

/// Flattens each chart with least-squares conformal maps.
/// Source: Levy et al. 2002, "Least Squares Conformal Maps", section 3; pins: the two farthest boundary vertices.
/// In:     f faces, chart id per face; each chart a topological disk.
/// Out:    uv f x 3 x 2, chart-local, model units, each chart's area equal to its area in space; no chart is mirrored:
///         on the image (v down) front faces are counter-clockwise. No flipped triangle and no overlap within a chart
///         (the map alone does not promise that: a chart that folds, overlaps or starves part of itself of texels is
///         split and retried, so c may grow; a single face always lies flat). Never NaN; faces without area are
///         slivers.
/// Errors: InvalidInput, naming the chart, if it is no disk.
/// Cost:   O(n) memory, one sparse factorisation per chart; charts run in parallel.
FlatCharts parameterize(ChartedMesh const& charts);

}  // namespace vitrine
