// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Flattens charts.

#include "stages/data.h"
#include "stages/options.h"

#include <vector>

namespace vitrine {

enum class Unfolding {
  conformal,  ///< least-squares conformal maps as they are: the paper's
  rigid,      ///< relaxed until faces keep their size: texels lie evenly
  detail      ///< relaxed towards more texels where the original shows more, see detail.h
};
template <>
struct EnumNames<Unfolding> {
  static constexpr std::array<std::string_view, 3> names{"conformal", "rigid", "detail"};
};

struct ParameterizeOptions {
  Unfolding unfolding = Unfolding::conformal;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(self.unfolding,
          Field{"unfolding", "",
                "how charts are laid flat: keeping angles; keeping sizes; or with more texels where colours vary"});
  }
};

/// Flattens each chart with least-squares conformal maps, and relaxes these where that is asked for.
/// Source: Levy et al. 2002, "Least Squares Conformal Maps", section 3; pins: the two farthest boundary vertices.
/// In:     f faces, chart id per face; each chart a topological disk. `lengths`: empty, the map stays conformal; else
///         per face the length that a length on it is to have on the map, see relax.h. A relaxed map that would fold or
///         overlap is not taken.
/// Out:    uv f x 3 x 2, chart-local, model units, each chart's area equal to its area in space, by `lengths` where
///         there are any; no chart is mirrored: on the image (v down) front faces are counter-clockwise. No flipped
///         triangle and no overlap within a chart (the map alone does not promise that: a chart that folds, overlaps or
///         starves part of itself of texels is split and retried, so c may grow; a single face always lies flat). Never
///         NaN; faces without area are slivers.
/// Errors: InvalidInput, naming the chart, if it is no disk.
/// Cost:   O(n) memory, one sparse factorisation per chart; charts run in parallel.
FlatCharts parameterize(ChartedMesh const& charts, std::vector<float> const& lengths = {});

}  // namespace vitrine
