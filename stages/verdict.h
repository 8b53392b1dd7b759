// SPDX-License-Identifier: Apache-2.0
#pragma once
/// 3D or pictures: which preview of an object costs fewer bytes at the same quality.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace vitrine {

/// An object as a series of pictures on a turntable.
struct RivalSeries {
  std::string codec;  ///< "webp80"
  int frames = 0;
  std::size_t bytes = 0;
  double turning_mse1e4 = 0;  ///< mean over the measure's views: the nearest frame, decoded, against the true view

  bool operator==(RivalSeries const&) const = default;
};

struct Verdict {
  bool thumbnail_wins = true;
  std::optional<RivalSeries> rival;  ///< the cheapest series that is at least as good; none: no series is
};

/// The rival is the cheapest series (of several the one with fewer frames, then the first) whose turning error is not
/// above the thumbnail's error. The thumbnail wins if it takes fewer bytes than its rival, and where it has none.
Verdict verdict(std::size_t thumbnail_bytes, double thumbnail_mse1e4, std::vector<RivalSeries> const& series);

}  // namespace vitrine
