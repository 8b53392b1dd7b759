// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What travels on the graph's edges: a model's job, and either the value of the last stage or the failure that ended
/// it.

#include "graph/meter.h"
#include "graph/options.h"
#include "graph/report.h"
#include "graph/study.h"
#include "graph/trace.h"
#include "io/archive.h"
#include "stages/judge.h"
#include "stages/own_texture.h"
#include "stages/progression.h"
#include "stages/surface_samples.h"

#include <memory>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

namespace vitrine::graph {

/// A model as every trial needs it: made once.
struct Original {
  SurveyedModel whole;                 ///< what pictures show
  std::optional<SurveyedModel> outer;  ///< what a thumbnail is made from, where much of the whole is hidden
  Reference reference;                 ///< of the certificate; without pictures where nothing is measured
  std::vector<Judge> judges;           ///< by which the search decides
  SurfaceSamples samples;              ///< none where nothing is searched

  /// What a thumbnail is made from.
  SurveyedModel const& model() const { return outer ? *outer : whole; }
};

/// Its simplifications.
struct Levels {
  std::optional<SimplifiedMesh> fixed;  ///< the one that the options ask for
  std::optional<Progression> plain, coloured;
  std::optional<TexturedMesh> textured;  ///< under the original's own texture, where that can be kept
};

/// One model on its way. Only the node that holds the message touches it; what it points to is immutable.
struct Job {
  io::ArchiveEntry const* entry = nullptr;
  RunOptions const* run = nullptr;
  std::uint64_t memory = 0;  ///< bytes that it was admitted with
  std::size_t number = 0;    ///< in the archive
  Meter* meter = nullptr;
  Trace* trace = nullptr;                        ///< where one is kept
  Trace::Clock::time_point admitted{}, ready{};  ///< ready: since then it waits for its next stage
  ModelRow row;
  std::shared_ptr<Original const> original;
  std::shared_ptr<Levels const> levels;
  std::optional<Study> study;
};
using JobPtr = std::shared_ptr<Job>;

template <class T>
struct Message {
  JobPtr job;
  std::variant<std::shared_ptr<T const>, Failure> value;  ///< immutable from here on
};

}  // namespace vitrine::graph
