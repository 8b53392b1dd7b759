// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What ends a worker although it lives: a model that hangs, silence, too much memory.

#include "io/archive.h"

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>

namespace vitrine::graph {

/// Where a model is.
struct Step {
  std::string stage;
  std::chrono::steady_clock::time_point since;
};
using Flight = std::map<std::string, Step>;  ///< the models under way, by slug

/// Why a worker is ended.
struct Sentence {
  std::string reason, remedy;
};

/// Seconds without progress after which a model is taken to hang.
double stall_limit(io::ArchiveEntry const& entry);

struct Limits {
  std::uint64_t memory = 0;  ///< bytes that the worker was granted; it may exceed them by a quarter and 256 MB
  double stall = 0;          ///< seconds that a model may stay in one stage; 0: by its size

  /// `entry` knows the archive; null for what is in none.
  std::optional<Sentence> hangs(Flight const& in_flight, std::chrono::steady_clock::time_point now,
                                std::function<io::ArchiveEntry const*(std::string const& slug)> const& entry) const;
  /// used: bytes.
  std::optional<Sentence> swells(std::uint64_t used) const;
};

/// Of one that has nothing under way and has said nothing for so long.
std::optional<Sentence> silent(std::chrono::steady_clock::duration since);

}  // namespace vitrine::graph
