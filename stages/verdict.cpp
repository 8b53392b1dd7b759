// SPDX-License-Identifier: Apache-2.0
#include "stages/verdict.h"

#include <tuple>

namespace vitrine {

Verdict verdict(std::size_t thumbnail_bytes, double thumbnail_mse1e4, std::vector<RivalSeries> const& series) {
  auto const price = [](RivalSeries const& s) { return std::tie(s.bytes, s.frames); };
  Verdict out;
  for (RivalSeries const& s : series)
    if (s.turning_mse1e4 <= thumbnail_mse1e4 && (!out.rival || price(s) < price(*out.rival))) out.rival = s;
  out.thumbnail_wins = !out.rival || thumbnail_bytes < out.rival->bytes;
  return out;
}

}  // namespace vitrine
