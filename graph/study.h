// SPDX-License-Identifier: Apache-2.0
#pragma once
/// One model's search: what was tried so far, and what comes next. The loop edge of the graph carries it along.

#include "graph/makings.h"
#include "graph/options.h"
#include "graph/report.h"
#include "stages/fit.h"

#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

namespace vitrine::graph {

class Study {
 public:
  Study(Subject const& subject, ModelOptions const& options);

  /// Whether another trial is to be made; if so, recipe() and options() are its own from here on.
  bool advance();
  Recipe const& recipe() const { return recipe_; }
  bool wants_atlas() const;  ///< else colours per vertex, or none

  /// Of this trial: to begin with what it shares with the best one so far. The stages add theirs.
  Makings& makings() { return makings_; }
  ModelOptions const& options() const { return trial_options_; }

  /// The trial's result. `error` and `score` as in Trial.
  void add(Made const& made, std::shared_ptr<EncodedThumbnail const> file, double error, double score);
  /// The trial could not be made.
  void add_failure(Failure const& failure);

  struct Winner {
    Made made;
    std::shared_ptr<EncodedThumbnail const> file;
  };
  std::vector<Trial> const& trials() const { return history_; }
  /// Why the last trial failed, where all did.
  Failure const* failure() const;
  /// Errors: NoSolution when no trial keeps within the limits.
  Winner const& winner() const;

 private:
  int first_quality() const;

  Subject subject_;
  ModelOptions options_, trial_options_;
  Recipe recipe_;
  std::vector<Trial> history_;
  std::vector<Winner> made_;  ///< per trial; without a file where it failed
  Makings makings_, best_makings_;
  double best_score_ = std::numeric_limits<double>::infinity();
  Failure last_failure_;
};

}  // namespace vitrine::graph
