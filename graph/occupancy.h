// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the cores did while models were converted, and what kept them from doing more.

#include "graph/admission.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <string_view>

namespace vitrine::graph {

/// Core-seconds, unless said otherwise. What was not computed or taken is idle, for one of five reasons.
struct Occupancy {
  double seconds = 0;    ///< wall time
  double available = 0;  ///< cores that the run may use, times wall time
  double computed = 0;
  double taken = 0;              ///< by other programs, while threads of this one waited for a core
  double memory = 0;             ///< idle: a model waited for memory that others held
  double reading = 0;            ///< idle: bytes came from the disk
  double writing = 0;            ///< idle: a model was being published
  double ending = 0;             ///< idle: no further model was left to begin
  double within = 0;             ///< idle: else; stages under way had no more to share out
  std::uint64_t disk_bytes = 0;  ///< read from the disk
  std::uint64_t peak = 0;        ///< most memory that the program held, bytes
  std::uint64_t admitted = 0;    ///< what it was estimated to hold then
  std::uint64_t most_admitted = 0, allowed = 0;

  Occupancy& operator+=(Occupancy const& later);
};

/// What a run was bound by.
enum class Bound { nothing, cores, memory, reading, writing, ending, within };

/// The cores, where less than a tenth of them was idle; else the reason for most of what was. Nothing: nothing ran.
Bound bound(Occupancy const& occupancy);
std::string_view shown(Bound bound);

/// A moment of the process, all counted from its start.
struct Moment {
  double seconds = 0, computed = 0, taken = 0;
  std::uint64_t disk_bytes = 0, memory = 0;
};

/// What stages are under way and what waits; where the time goes that passes meanwhile. Not thread-safe.
class Tally {
 public:
  /// cores: that the run may use; allowed: bytes of --memory; program: bytes of these for no model.
  Tally(double cores, std::uint64_t allowed, std::uint64_t program, Moment const& start)
      : cores_(cores), allowed_(allowed), program_(program), last_(start), admitted_(program) {}

  /// A stage of a model begins; the ticket is for its end, which gives the most memory that the process held meanwhile.
  std::size_t begin(std::string_view stage);
  std::uint64_t end(std::size_t ticket, std::uint64_t memory);
  void admission(Admission const& admission);

  /// Time has passed, under what was said last.
  void pass(Moment const& now);
  /// What has come together since the last call.
  Occupancy take();

 private:
  struct Running {
    std::string_view stage;
    std::uint64_t peak;
  };
  bool runs(std::string_view stage) const;
  double& reason(bool from_disk);

  double cores_;
  std::uint64_t allowed_, program_;
  Moment last_;
  Occupancy sums_;
  std::map<std::size_t, Running> running_;
  std::size_t tickets_ = 0;
  std::uint64_t admitted_;
  bool waits_ = false, waits_for_memory_ = false;
};

}  // namespace vitrine::graph
