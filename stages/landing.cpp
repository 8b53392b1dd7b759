// SPDX-License-Identifier: Apache-2.0
#include "stages/landing.h"

#include "stages/byte_model.h"

#include <algorithm>
#include <cmath>

namespace vitrine {
namespace {

constexpr double kAim = 0.99, kFull = 0.97;  ///< of the ceiling
constexpr double kAimError = 0.98, kNear = 0.96;  ///< of the error

double log_ratio(double a, double b) { return std::log(std::max(a, 1e-6) / std::max(b, 1e-6)); }

std::optional<int> between(double triangles, int low, int high) {
  if (low > high) return {};
  return std::clamp(int(std::clamp(triangles, 0.0, 1e6)), low, high);
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
  if (!below && from.recipe.triangles <= limits.fewest) return {};
  double const rate = below && above ? (double(above->bytes) - double(below->bytes)) /
                                           double(above->recipe.triangles - below->recipe.triangles)
                                     : bytes_per_triangle(from);
  double const more = (kAim * limits.ceiling - double(from.bytes)) / std::max(0.1, rate);
  return between(from.recipe.triangles + std::trunc(more), below ? below->recipe.triangles + 1 : limits.fewest,
                 above ? above->recipe.triangles - 1 : limits.most);
}

std::optional<int> triangles_for_error(std::span<Trial const> like, Landing const& limits) {
  Trial const *good = nullptr, *bad = nullptr;
  for (Trial const& t : like) {
    bool const fits = t.error <= limits.max_error;
    if (fits && (!good || t.recipe.triangles < good->recipe.triangles)) good = &t;
    if (!fits && (!bad || t.recipe.triangles > bad->recipe.triangles)) bad = &t;
  }
  if (good && (good->error >= kNear * limits.max_error || good->recipe.triangles <= limits.fewest)) return {};
  if (!good && bad->recipe.triangles >= limits.most) return {};
  Trial const& from = good ? *good : *bad;
  double power = kErrorPower;
  if (good && bad) power = log_ratio(bad->error, good->error) / log_ratio(good->recipe.triangles, bad->recipe.triangles);
  double const factor = std::exp(log_ratio(from.error, kAimError * limits.max_error) / std::max(power, 0.1));
  return between(from.recipe.triangles * factor, bad ? bad->recipe.triangles + 1 : limits.fewest,
                 good ? good->recipe.triangles - 1 : limits.most);
}

}  // namespace vitrine
