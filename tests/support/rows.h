// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the graph makes of an archive, to be looked at afterwards.

#include "graph/pipeline.h"

#include <vector>

namespace vitrine::test {

/// One row per entry, in the archive's order.
inline std::vector<graph::ModelRow> converted(io::Archive const& archive, graph::ModelOptions const& options,
                                              graph::RunOptions const& run) {
  std::vector<graph::ModelRow> rows(archive.entries.size());
  graph::run_pipeline(archive, options, run, [&](graph::ModelRow const& row, std::size_t entry) { rows[entry] = row; });
  return rows;
}

}  // namespace vitrine::test
