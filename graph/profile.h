// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Where the time of many models went, stage by stage.

#include "graph/report.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace vitrine::graph {

struct StageProfile {
  std::string stage;
  std::size_t models = 0;         ///< that went through
  double seconds = 0;             ///< wall time of its work, over all models
  double share = 0;               ///< of all stages' seconds
  double waiting = 0;             ///< seconds that models waited for it, from the end of the stage before
  std::uint64_t peak_memory = 0;  ///< most memory that the program held while it ran for any model, bytes
};

/// In the order in which models first went through.
class Profile {
 public:
  void add(ModelRow const& row);
  std::vector<StageProfile> stages() const;

 private:
  StageProfile& of(std::string const& stage);

  std::vector<StageProfile> stages_;
};

nlohmann::ordered_json profile_json(std::vector<StageProfile> const& stages);

}  // namespace vitrine::graph
