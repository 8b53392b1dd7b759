// SPDX-License-Identifier: Apache-2.0
#include "stages/landing.h"

#include "stages/byte_model.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace vitrine {
namespace {

constexpr double kAim = 0.99, kFull = 0.97;       ///< of the ceiling
constexpr double kAimError = 0.98, kNear = 0.96;  ///< of the error

constexpr std::size_t kLines = 4;    ///< trials: where these led nowhere, every other one halves the gap
constexpr double kLeastPower = 0.3;  ///< with which error is taken to fall: no step is larger than it would need

double log_ratio(double a, double b) { return std::log(std::max(a, 1e-6) / std::max(b, 1e-6)); }

std::optional<int> between(double extent, int low, int high) {
  if (low > high) return {};
  return std::clamp(int(std::clamp(extent, 0.0, 1e8)), low, high);
}

}  // namespace

std::optional<int> triangles_for_bytes(std::span<Trial const> like, Landing const& limits) {
  Trial const *below = nullptr, *above = nullptr;
  for (Trial const& t : like) {
    bool const fits = double(t.bytes) <= limits.ceiling;
    if (fits && (!below || t.recipe.triangles > below->recipe.triangles)) below = &t;
    if (!fits && (!above || t.recipe.triangles < above->recipe.triangles)) above = &t;
  }
  if (below && (below->recipe.triangles >= limits.most || double(below->bytes) >= kFull * limits.ceiling)) return {};
  Trial const& from = below ? *below : *above;
  if (!below && from.recipe.triangles <= limits.least) return {};
  double const rate = below && above ? (double(above->bytes) - double(below->bytes)) /
                                           double(above->recipe.triangles - below->recipe.triangles)
                                     : bytes_per_triangle(from);
  double const more = (kAim * limits.ceiling - double(from.bytes)) / std::max(0.1, rate);
  return between(from.recipe.triangles + std::trunc(more), below ? below->recipe.triangles + 1 : limits.least,
                 above ? above->recipe.triangles - 1 : limits.most);
}

std::optional<int> extent_for_error(std::span<Trial const> like, Landing const& limits) {
  std::vector<Trial> trials(like.begin(), like.end());
  std::ranges::stable_sort(trials, {}, [](Trial const& t) { return extent(t.recipe); });
  auto const good = std::ranges::find_if(trials, [&](Trial const& t) { return t.error <= limits.max_error; });
  bool const any = good != trials.end(), both = any && good != trials.begin();
  int const low = good == trials.begin() ? limits.least : extent(good[-1].recipe) + 1;
  int const high = any ? extent(good->recipe) - 1 : limits.most;
  if (any && good->error >= kNear * limits.max_error) return {};
  if (both && trials.size() >= kLines && trials.size() % 2 == 0)
    return between(std::sqrt(double(low) * high), low, high);
  // The line in logarithms through the two that are next to the error.
  Trial const& from = any ? *good : trials.back();
  Trial const* other = both ? &good[-1] : trials.size() > 1 ? (any ? &good[1] : &trials.end()[-2]) : nullptr;
  double const rise = other ? log_ratio(extent(from.recipe), extent(other->recipe)) : 0;
  double const power = rise != 0 ? log_ratio(other->error, from.error) / rise : kErrorPower;
  double const factor = std::exp(log_ratio(from.error, kAimError * limits.max_error) / std::max(power, kLeastPower));
  return between(extent(from.recipe) * factor, low, high);
}

}  // namespace vitrine
