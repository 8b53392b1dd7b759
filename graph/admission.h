// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Which models are under way: a bound on their estimated memory and on their number. Holds a queue, never a thread.

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

namespace vitrine::graph {

/// Not thread-safe: a serial node of the graph owns it.
class Admission {
 public:
  /// memory: bytes that models under way may take together; models: how many at most.
  Admission(std::uint64_t memory, std::size_t models) : memory_(memory), models_(models) {}

  bool fits_at_all(std::uint64_t bytes) const { return bytes <= memory_; }

  /// Queues job number `id`. It must fit at all.
  void wait(std::size_t id, std::uint64_t bytes) { waiting_.push_back({id, bytes}); }
  /// Gives back what an admitted job held.
  void release(std::uint64_t bytes);
  /// The jobs that may start now, oldest first. A job that does not fit lets smaller ones pass, but only `kPatience` of
  /// them: then nothing starts before it.
  std::vector<std::size_t> admit();

  std::uint64_t memory_in_use() const { return used_; }
  std::size_t models_in_flight() const { return running_; }
  std::size_t models_waiting() const { return waiting_.size(); }
  /// Right after admit(): whether a model waits for nothing else.
  bool waits_for_memory() const { return !waiting_.empty() && running_ < models_; }

 private:
  static constexpr int kPatience = 64;
  struct Waiting {
    std::size_t id;
    std::uint64_t bytes;
    int passed = 0;
  };
  std::uint64_t memory_, used_ = 0;
  std::size_t models_, running_ = 0;
  std::deque<Waiting> waiting_;
};

/// 80 % of the memory that this process may still take: the machine's available memory or the control group's limit.
std::uint64_t default_memory();

}  // namespace vitrine::graph
