// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What happens to many models: the flow graph from an archive to published thumbnails.

#include "graph/options.h"
#include "graph/report.h"
#include "io/archive.h"

#include <cstddef>
#include <functional>

namespace vitrine::graph {

/// Hears of each model that leaves the graph, from one thread at a time; `entry` is its place in the archive.
using Watcher = std::function<void(ModelRow const& row, std::size_t entry)>;

/// Converts every entry of the archive and publishes GALLERY/models/<slug>/ with thumb.glb, poster.jpg and
/// certificate.json. `finished` hears of each entry once, as it is done; nothing of it is kept. A model that fails
/// costs its row and nothing else. The same bytes for the same archive and options, at any number of threads.
void run_pipeline(io::Archive const& archive, ModelOptions const& options, RunOptions const& run,
                  Watcher const& finished);

}  // namespace vitrine::graph
