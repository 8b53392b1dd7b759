// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What `convert --dry-run` says.

#include "graph/work.h"

#include <map>
#include <string>
#include <vector>

namespace vitrine::tools {

struct Rehearsal {
  io::Archive archive;
  std::vector<graph::Record> fresh;
  std::map<std::string, std::string> todo;  ///< by slug, why
};

/// Each model that would be converted and why; then their number, time, bytes and memory. The time follows from how
/// long the gallery's other models took; without any, from what a model of that size takes in general.
std::string rehearsal_text(Rehearsal const& rehearsal, graph::Work const& work);

}  // namespace vitrine::tools
