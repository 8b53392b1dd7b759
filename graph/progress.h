// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How far a run is: a bar on a terminal, one line a minute elsewhere. The ETA goes by cost, not by count.

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <string>
#include <thread>

namespace vitrine::graph {

/// What is done of what there is to do.
struct ProgressState {
  std::size_t models = 0, done = 0, failed = 0;
  double cost = 0, cost_done = 0;  ///< in any unit that is proportional to time
  double seconds = 0;              ///< since the start
};

/// "[####------] 12/40 models  3 failed  5.2/min  ETA 00:07:10"; `width` 0 leaves the bar out.
std::string progress_line(ProgressState const& state, int width);

/// Prints to stderr from a thread of its own until destroyed.
class Progress {
 public:
  /// live: redraw in place twice a second; else a line a minute.
  Progress(std::size_t models, double cost, bool live);
  ~Progress();

  void finished(double cost, bool failed);
  /// Prints a whole line without tearing the bar.
  void say(std::string const& line);

 private:
  void run(std::stop_token stop);
  void draw();

  std::mutex mutex_;
  std::condition_variable_any wake_;
  ProgressState state_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  bool live_;
  std::jthread thread_;
};

}  // namespace vitrine::graph
