// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Everything that can be chosen, as one value; and its visitor, from which flags, reports and docs/options.md follow.

#include "graph/occupancy.h"
#include "io/archive.h"
#include "io/read_model.h"
#include "io/write_glb.h"
#include "stages/bake.h"
#include "stages/cluster.h"
#include "stages/fit.h"
#include "stages/pack.h"
#include "stages/quantize.h"
#include "stages/segment.h"
#include "stages/simplify.h"

#include <filesystem>
#include <functional>
#include <stop_token>
#include <string_view>

namespace vitrine::graph {

/// What is written beside each thumbnail.
struct PublishOptions {
  bool certificate = true;
  bool series = false;
  int series_rows = 1;
  int viewport = 200;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(self.certificate,
          Field{"certificate", "", "measure each written file against its original and write certificate.json"});
    visit(self.series, Field{"series", "", "write the rival, too: a turntable of pictures in series/"});
    visit(self.series_rows, Field{"series-rows", "rows",
                                  "of such a series: further turns, evenly up to 80 degrees above the horizon", 1, 8});
    visit(self.viewport,
          Field{"viewport", "pixels", "side of the pictures that are measured, and of poster.jpg", 11, 1024});
  }
};

/// What happens to each model. All of it changes the files that come out.
struct ModelOptions {
  io::ReadOptions read;
  ClusterOptions cluster;
  FitOptions fit;
  SimplifyOptions simplify{.triangles = 0};
  SegmentOptions segment;
  ParameterizeOptions parameterize;
  PackOptions pack{.texture = 0};
  QuantizeOptions quantize;
  BakeOptions bake;
  io::EncodeOptions encode;
  PublishOptions publish;
};

/// Whether the search decides. --triangles or --texture, not 0, switch it off: then all else is taken as it stands
/// here.
inline bool searches(ModelOptions const& options) {
  return options.simplify.triangles == 0 && options.pack.texture == 0;
}

/// visit(group, options struct) for each struct with fields, in the order of the stages.
template <class Self, class Visitor>
void option_groups(Self& self, Visitor&& visit) {
  visit("Cluster", self.cluster);
  visit("Fit", self.fit);
  visit("Simplify", self.simplify);
  visit("Segment", self.segment);
  visit("Parameterize", self.parameterize);
  visit("Pack", self.pack);
  visit("Quantize", self.quantize);
  visit("Bake", self.bake);
  visit("Encode", self.encode);
  visit("Publish", self.publish);
}

/// How the run uses the machine. None of it changes what comes out.
struct RunOptions {
  int threads = 0;           ///< 0: all cores
  std::uint64_t memory = 0;  ///< bytes that the program may take; 0: default_memory()
  std::filesystem::path gallery;
  std::filesystem::path trace{};  ///< where to write what happened when; empty: nowhere
  std::size_t models = 0;         ///< under way at once; 0: twice the threads
  std::function<void(io::ArchiveEntry const&, std::string_view stage)>
      stage{};  ///< a model enters a stage; from any thread
  std::function<void(Occupancy const& since_the_last)>
      occupied{};          ///< at the end of each model; from one thread at a time
  std::stop_token stop{};  ///< once stop is requested, no further model is begun
};

}  // namespace vitrine::graph
