// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What travels on the graph's edges: a model's job, and either the value of the last stage or the failure that ended
/// it.

#include "graph/report.h"
#include "io/archive.h"

#include <memory>
#include <utility>
#include <variant>

namespace vitrine::graph {

/// One model on its way. Only the node that holds the message touches it.
struct Job {
  io::ArchiveEntry const* entry = nullptr;
  std::uint64_t memory = 0;  ///< bytes that it was admitted with
  ModelRow row;
};
using JobPtr = std::shared_ptr<Job>;

template <class T>
struct Message {
  JobPtr job;
  std::variant<std::shared_ptr<T const>, Failure> value;  ///< immutable from here on
};

}  // namespace vitrine::graph
