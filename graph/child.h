// SPDX-License-Identifier: Apache-2.0
#pragma once
/// This program, started again as the guard's worker: with pipes, in a process group of its own.

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace vitrine::graph {

/// Set in the worker's environment.
constexpr char kWorkerVariable[] = "VITRINE_WORKER";

class Child {
 public:
  /// Starts /proc/self/exe with `arguments`. `lock` stays open in it, so that the lock outlives this process if need
  /// be.
  /// Errors: std::system_error.
  Child(std::vector<std::string> const& arguments, int lock);
  ~Child();  ///< kills what is still there
  Child(Child const&) = delete;
  Child& operator=(Child const&) = delete;

  int orders() const { return orders_; }  ///< to write; it stops at once when this end is closed
  int events() const { return events_; }  ///< to read, without waiting
  int log() const { return log_; }        ///< its standard error, likewise
  void kill() const;                      ///< it, and whatever it has started

  /// As waitpid tells it; nothing while it runs.
  std::optional<int> status();
  /// Bytes of memory that only it holds; files it has mapped do not count.
  std::uint64_t memory() const;

 private:
  pid_t pid_ = -1;
  int orders_ = -1, events_ = -1, log_ = -1;
  std::optional<int> status_;
};

/// "killed by SIGSEGV (Segmentation fault)", "left with exit code 3".
std::string describe_status(int status);

}  // namespace vitrine::graph
