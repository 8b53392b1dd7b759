// SPDX-License-Identifier: Apache-2.0
#include "graph/profile.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace vitrine::graph {

StageProfile& Profile::of(std::string const& stage) {
  auto const found =
      std::find_if(stages_.begin(), stages_.end(), [&](StageProfile const& s) { return s.stage == stage; });
  if (found != stages_.end()) return *found;
  stages_.push_back({});
  stages_.back().stage = stage;
  return stages_.back();
}

void Profile::add(ModelRow const& row) {
  for (auto const& [stage, seconds] : row.seconds) {
    StageProfile& sum = of(stage);
    ++sum.models;
    sum.seconds += seconds;
  }
  for (auto const& [stage, seconds] : row.waiting) of(stage).waiting += seconds;
  for (auto const& [stage, peak] : row.peaks) of(stage).peak_memory = std::max(of(stage).peak_memory, peak);
}

std::vector<StageProfile> Profile::stages() const {
  double all = 0;
  for (StageProfile const& s : stages_) all += s.seconds;
  std::vector<StageProfile> stages = stages_;
  for (StageProfile& s : stages) s.share = all > 0 ? s.seconds / all : 0;
  return stages;
}

nlohmann::ordered_json profile_json(std::vector<StageProfile> const& stages) {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (StageProfile const& s : stages)
    out.push_back({{"stage", s.stage},
                   {"models", s.models},
                   {"seconds", s.seconds},
                   {"share", s.share},
                   {"waiting", s.waiting},
                   {"peakMemory", s.peak_memory}});
  return out;
}

}  // namespace vitrine::graph
