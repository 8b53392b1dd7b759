// SPDX-License-Identifier: Apache-2.0
#include "stages/winner.h"

#include "stages/error.h"
#include "stages/inquiry.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace vitrine {
namespace {

/// What the winner has the least of.
double rank(Subject const& subject, FitOptions const& options, Trial const& trial) {
  if (options.max_error > 0) return double(trial.bytes);
  return subject.fixed_triangles > 0 ? size_cost(trial) : trial.score;
}

Trial const& smallest_of(std::span<Trial const> history) {
  return *std::ranges::min_element(history, {}, &Trial::bytes);
}

std::string text(double value) {
  std::string digits = std::to_string(value);
  return digits.substr(0, digits.find('.') + 3);
}

}  // namespace

std::optional<std::size_t> best_within(Subject const& subject, FitOptions const& options,
                                       std::span<Trial const> history) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < history.size(); ++i) {
    Trial const& t = history[i];
    if (double(t.bytes) > 1000 * options.max_kb || (options.max_error > 0 && t.error > options.max_error)) continue;
    if (!best || rank(subject, options, t) < rank(subject, options, history[*best])) best = i;
  }
  return best;
}

std::optional<Recipe> shrunk(Subject const& subject, FitOptions const& options, std::span<Trial const> history) {
  constexpr double kLess = 0.9;
  if (best_within(subject, options, history)) return {};
  Trial const& smallest = smallest_of(history);
  Recipe recipe = smallest.recipe;
  double const share = kLess * 1000 * options.max_kb / double(smallest.bytes);
  recipe.triangles = std::max(kFewest, int(recipe.triangles * share));
  recipe.texture = std::max(kSmallestTexture, int(recipe.texture * std::sqrt(share)));
  bool const tried = std::ranges::find(history, recipe, &Trial::recipe) != history.end();
  return tried ? std::nullopt : std::optional(recipe);
}

Trial failed_trial(Recipe const& recipe) {
  constexpr double worst = std::numeric_limits<double>::infinity();
  return {recipe, std::numeric_limits<std::size_t>::max(), 0, 0, worst, worst};
}

std::size_t best_trial(Subject const& subject, FitOptions const& options, std::span<Trial const> history) {
  if (std::optional<std::size_t> const best = best_within(subject, options, history)) return *best;
  auto const nearer = [](Trial const& a, Trial const& b) { return a.error < b.error; };
  Trial const& smallest = smallest_of(history);
  Trial const nearest = *std::min_element(history.begin(), history.end(), nearer);
  if (options.max_error > 0)
    throw Error(ErrorKind::no_solution,
                "no file of " + text(options.max_kb) + " KB has an error of " + text(options.max_error) +
                    "; the least found is " + text(nearest.error) + " at " + text(double(nearest.bytes) / 1000) + " KB",
                "raise --max-kb or --max-error");
  throw Error(ErrorKind::no_solution,
              "no file keeps to " + text(options.max_kb) + " KB; the smallest found has " +
                  text(double(smallest.bytes) / 1000) + " KB",
              "raise --max-kb");
}

}  // namespace vitrine
