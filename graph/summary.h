// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The morning after: what the night did; tools/morning.h says it to people.

#include "graph/guard.h"
#include "graph/night.h"
#include "graph/profile.h"

#include <nlohmann/json.hpp>

#include <string>
#include <utility>
#include <vector>

namespace vitrine::graph {

struct Summary {
  std::size_t models = 0, done = 0, failed = 0, quarantined = 0, pending = 0;
  std::size_t converted = 0;   ///< by this run, failures included
  std::size_t up_to_date = 0;  ///< since an earlier one
  std::uint64_t bytes = 0;     ///< of all thumbnails
  std::uint64_t disk = 0;      ///< of all published files of models
  double seconds = 0;          ///< wall time

  struct Problem {
    std::string input, status, stage, reason, remedy;
    bool is_new = false;  ///< this run saw it first
  };
  std::vector<Problem> problems;
  std::vector<std::pair<std::string, std::size_t>> reasons;    ///< "stage: reason" and how many models, most first
  std::vector<std::pair<std::string, double>> slowest;         ///< of this run; seconds of work
  std::vector<std::pair<std::string, std::uint64_t>> repairs;  ///< by kind, over all models
  std::vector<StageProfile> stages;                            ///< of what this run converted
  std::vector<std::string> orphans;                            ///< folders of models that are no longer in the archive
  GuardReport guard;
  std::string retry;  ///< the command that tries failures again
};

Summary summarise(Night const& night, GuardReport const& guard, double seconds, std::filesystem::path const& gallery);

/// The key `run` of report.json: all that differs from run to run.
nlohmann::ordered_json run_json(Summary const& summary);

}  // namespace vitrine::graph
