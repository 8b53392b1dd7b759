// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What happens to many models: the flow graph from an archive to published thumbnails.

#include "graph/report.h"
#include "io/archive.h"
#include "io/read_model.h"
#include "io/write_glb.h"
#include "stages/bake.h"
#include "stages/pack.h"
#include "stages/quantize.h"
#include "stages/segment.h"
#include "stages/simplify.h"

#include <filesystem>
#include <functional>
#include <vector>

namespace vitrine::graph {

/// What happens to each model. All of it changes the bytes that come out.
struct ModelOptions {
  io::ReadOptions read;
  SimplifyOptions simplify;
  SegmentOptions segment;
  PackOptions pack;
  QuantizeOptions quantize;
  BakeOptions bake;
  io::EncodeOptions encode;
};

/// visit(group, options struct) for each struct with fields, in the order of the stages.
template <class Self, class Visitor>
void option_groups(Self& self, Visitor&& visit) {
  visit("Simplify", self.simplify);
  visit("Segment", self.segment);
  visit("Pack", self.pack);
  visit("Quantize", self.quantize);
  visit("Bake", self.bake);
  visit("Encode", self.encode);
}

/// How the run uses the machine. None of it changes what comes out.
struct RunOptions {
  int threads = 0;           ///< 0: all cores
  std::uint64_t memory = 0;  ///< bytes that the program may take; 0: default_memory()
  std::filesystem::path gallery;
};

/// Hears of each model that leaves the graph, from one thread at a time; `entry` is its place in the archive.
using Watcher = std::function<void(ModelRow const& row, std::size_t entry)>;

/// Converts every entry of the archive and publishes GALLERY/models/<slug>/thumb.glb.
/// Returns one row per entry, in the archive's order; a model that fails costs its row and nothing else.
/// The same bytes for the same archive and options, at any number of threads.
std::vector<ModelRow> run_pipeline(io::Archive const& archive, ModelOptions const& options, RunOptions const& run,
                                   Watcher const& finished = {});

}  // namespace vitrine::graph
