// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The process that outlives the night. It starts a worker, listens to it, and starts another when one dies or hangs;
/// what was under way then runs one at a time, and the model that takes its worker down is quarantined. It opens no
/// model.

#include "graph/night.h"
#include "graph/options.h"
#include "graph/strict_json.h"

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace vitrine::graph {

struct GuardOptions {
  std::vector<std::string> arguments;  ///< of this program's command line
  int lock = -1;                       ///< descriptor of the gallery's lock
  std::filesystem::path gallery;
  ModelOptions model;
  std::uint64_t memory = 0;  ///< bytes that the worker may take; 0: default_memory()
  double stall_limit = 0;    ///< seconds that a model may stay in one stage; 0: by its size
  std::optional<std::chrono::system_clock::time_point> stop_at;
};

enum class Ending {
  complete,     ///< every model has its row
  interrupted,  ///< by a signal, or by the clock
  disk,         ///< the gallery's disk is full
  machine,      ///< the gallery cannot be written, or no worker lives
  refused       ///< the archive cannot be read
};

struct GuardReport {
  Ending ending = Ending::complete;
  std::string reason;                ///< of an ending that is not complete
  std::string confinement, missing;  ///< of the worker, see confinement.h
  int workers = 0;                   ///< that were started
  Occupancy occupancy;               ///< of them all, while they converted models
};

/// Is told of everything: for progress, logs and status files.
struct GuardListener {
  std::function<void(StrictJson const& message)> event;  ///< each message of the worker, and the guard's own
  std::function<void(std::string const& line)> say;      ///< for people
  std::function<void()> converting;                      ///< night.todo() is what will be converted
  std::function<void(Record const& record)> left;        ///< a model is through, however
  std::function<void()> tick;                            ///< several times a second
};

/// Runs until all is done or nothing can be done. The work is what this program's command line says.
GuardReport guard(Night& night, GuardOptions const& options, GuardListener const& listener);

}  // namespace vitrine::graph
