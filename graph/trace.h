// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a run did and when, for Perfetto or chrome://tracing: Chrome's trace event format.

#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace vitrine::graph {

/// Notes from any thread. Two groups of tracks: each thread with the stages that it ran, and each model with its stages
/// inside, from its admission on; and counters of models under way, memory admitted and memory used. Times are
/// microseconds since the start.
class Trace {
 public:
  using Clock = std::chrono::steady_clock;

  /// `stage` must outlive the trace. `thread`: where it ran, from 0.
  void stage(std::size_t model, std::string_view stage, int thread, Clock::time_point begin, Clock::time_point end);
  /// The model is done, or has failed; everything that happened to it lies between.
  void model(std::size_t model, std::string const& name, Clock::time_point begin, Clock::time_point end);
  void memory(std::uint64_t admitted, std::size_t models);

  std::string json() const;

 private:
  struct Span {
    std::size_t model;
    std::string_view stage;
    int thread;
    std::int64_t begin, end;
  };
  struct Model {
    std::size_t number;
    std::string name;
    std::int64_t begin, end;
  };
  struct Memory {
    std::int64_t at;
    std::uint64_t admitted, used;
    std::size_t models;
  };

  std::int64_t since_start(Clock::time_point at) const {
    return std::chrono::duration_cast<std::chrono::microseconds>(at - start_).count();
  }

  Clock::time_point start_ = Clock::now();
  mutable std::mutex mutex_;
  std::vector<Span> spans_;
  std::vector<Model> models_;
  std::vector<Memory> memory_;
};

/// Bytes of this process in memory now, and the most that it or a worker of it had.
std::uint64_t memory_used();
std::uint64_t peak_memory();
/// Seconds that its threads and its workers have computed so far.
double cpu_seconds();

}  // namespace vitrine::graph
