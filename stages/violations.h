// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the checks of data.h find, and the checks of flat charts among them. Internal to check.

#include "stages/data.h"

#include <string>
#include <utility>
#include <vector>

namespace vitrine {

using Violations = std::vector<std::string>;

inline void require(bool holds, std::string violation, Violations& violations) {
  if (!holds) violations.push_back(std::move(violation));
}

/// As "face 7".
inline std::string number(std::string const& what, std::size_t i) { return what + " " + std::to_string(i); }

/// Each triangle the right way up. In: charts below `charts`, texture coordinates that are finite.
void check_folds(std::vector<std::uint32_t> const& face_charts, std::uint32_t charts,
                 std::vector<CornerUvs> const& corner_uvs, Violations& violations);
/// No two triangles of a chart over each other, and each chart as large as its surface.
void check_flatness(FlatCharts const& charts, Violations& violations);
/// No texel of two charts, and as many free ones between them as the atlas promises.
void check_gutters(Atlas const& atlas, Violations& violations);

}  // namespace vitrine
