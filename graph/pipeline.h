// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What happens to many models: the flow graph from an archive to published thumbnails.

#include "graph/options.h"
#include "graph/report.h"
#include "io/archive.h"

#include <functional>
#include <vector>

namespace vitrine::graph {

/// Hears of each model that leaves the graph, from one thread at a time; `entry` is its place in the archive.
using Watcher = std::function<void(ModelRow const& row, std::size_t entry)>;

/// Converts every entry of the archive and publishes GALLERY/models/<slug>/ with thumb.glb, poster.jpg and certificate.json.
/// Returns one row per entry, in the archive's order; a model that fails costs its row and nothing else.
/// The same bytes for the same archive and options, at any number of threads.
std::vector<ModelRow> run_pipeline(io::Archive const& archive, ModelOptions const& options, RunOptions const& run,
                                   Watcher const& finished = {});

}  // namespace vitrine::graph
