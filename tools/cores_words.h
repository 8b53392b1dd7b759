// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Where a run's time went, and what bound it, for people.

#include "graph/occupancy.h"
#include "graph/profile.h"

#include <string>
#include <vector>

namespace vitrine::tools {

/// "bound by the cores: 97 % computing, 2 % idle (1 % no further model to begin, 1 % writing), 1 % taken by other
/// programs"
std::string cores_words(graph::Occupancy const& occupancy);

/// "memory: at most 1.81 GB held, where 2.10 GB were estimated; 18.94 GB allowed"
std::string memory_words(graph::Occupancy const& occupancy);

/// "time: weigh 41 %, simplify 20 %, others 39 %": the stages that took most.
std::string stages_words(std::vector<graph::StageProfile> stages);

/// A table of all stages, under a heading; "" without any.
std::string stages_html(std::vector<graph::StageProfile> const& stages);

}  // namespace vitrine::tools
