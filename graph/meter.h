// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Looks at this process many times a second while models are converted: its cores, its memory, its disk.

#include "graph/occupancy.h"

#include <condition_variable>
#include <mutex>
#include <thread>

namespace vitrine::graph {

/// Runs a thread of its own until destroyed. All calls from any thread.
class Meter {
 public:
  Meter(std::size_t threads, std::uint64_t allowed, std::uint64_t program);

  std::size_t begin(std::string_view stage);
  /// The most memory that the process held since the stage began.
  std::uint64_t end(std::size_t ticket);
  void admission(Admission const& admission);
  /// What has come together since the last call.
  Occupancy take();

 private:
  void run(std::stop_token stop);

  std::mutex mutex_;
  std::condition_variable_any wake_;
  Tally tally_;
  std::jthread thread_;
};

/// This process now. Seconds that its threads waited for a core are those of the threads that live.
Moment this_moment();

}  // namespace vitrine::graph
