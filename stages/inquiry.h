// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the search for the best file has asked and heard: recipes, and the trials that answer them. Internal to fit.

#include "stages/fit.h"

#include <cstddef>
#include <optional>
#include <span>
#include <utility>

namespace vitrine {

inline constexpr double kMapShare = 0.5;  ///< of the bytes: for a first map
inline constexpr int kSmallestTexture = 16;
inline constexpr int kFewest = 40;  ///< triangles
inline constexpr int kSteps = 3;    ///< in one direction

/// Questions are asked in the same order each time; the trials so far answer the first of them.
class Inquiry {
 public:
  enum class Answer { none, worse, better };
  using Change = void (*)(Recipe&);

  Inquiry(Subject const& subject, FitOptions const& options, std::span<Trial const> history);

  Recipe const& asked() const { return asked_; }  ///< last
  Recipe const& best() const { return history_[best_].recipe; }
  Trial const& best_trial() const { return history_[best_]; }
  Trial const& trial(std::size_t index) const { return history_[index]; }
  double aim() const;                       ///< bytes: what explorations aim for
  int size() const { return int(usual_); }  ///< bytes of the files that are compared
  int most() const;                         ///< triangles

  /// The recipe with as many triangles as the bytes allow; once more where it misses them by far, as then two recipes
  /// cannot be compared.
  Answer ask(Recipe recipe);
  /// The best recipe so far, changed.
  Answer ask_with(Change change);
  /// Another split between triangles and map.
  Answer ask_as_it_is(Recipe recipe);
  /// What the history says; the better of both recipes is the best one from here on.
  Answer answer_to(Recipe recipe);
  /// The last trial counts as the best one, whatever it cost. Returns the one that did.
  std::size_t take_last() { return std::exchange(best_, answered_ - 1); }
  /// That trial is the best one again where its cost is lower by more than `margin` than that of the one that counts as
  /// best.
  void take_better(std::size_t trial, double margin) {
    if (cost(history_[trial]) < cost(history_[best_]) - margin) best_ = trial;
  }
  /// One way as long as that pays, else the other way.
  Answer walk(Answer (Inquiry::*question)(Recipe), Change one, Change other, int steps = kSteps);
  /// From here on files of about as many bytes as the error needs are compared: found by making the best one larger or
  /// smaller.
  Answer resize();

  /// At the end: as many triangles as the limit allows, or as few as it needs. Nothing when that is found.
  std::optional<Recipe> land();

  int affordable(Recipe const& recipe) const;  ///< triangles
  bool is_whole(Trial const& trial) const { return trial.recipe.triangles >= most(); }
  /// So much worse than the best one that it is not asked again.
  bool is_hopeless(Trial const& trial) const;
  double cost(Trial const& trial) const;
  double last_cost() const { return cost(history_[answered_ - 1]); }

 private:
  double ceiling() const { return 1000 * options_.max_kb; }
  int largest_texture(Recipe const& recipe) const;
  int beside(double map_bytes, Recipe const& recipe) const;
  int bounded(int triangles) const;
  double bytes_for_error(Trial const& here, Trial const* before) const;
  /// Made larger or smaller; all triangles stay as long as they leave the map half of its share.
  Recipe of_extent(Trial const& like, int wanted) const;
  bool is_like(Trial const& trial) const;
  /// With as many triangles, nearly.
  bool is_tried(Recipe const& recipe) const;

  Subject subject_;
  FitOptions options_;
  std::span<Trial const> history_;
  double usual_;  ///< see size()
  std::size_t answered_ = 0, best_ = 0;
  Recipe asked_;
};

/// Where the number of triangles is fixed, bytes are saved as long as that shows little.
double size_cost(Trial const& trial);

}  // namespace vitrine
