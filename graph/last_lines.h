// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The end of what a worker, or a library in it, prints: evidence when it dies.

#include <cstddef>
#include <deque>
#include <functional>
#include <string>

namespace vitrine::graph {

class LastLines {
 public:
  /// Reads once from the pipe, which does not wait; hands on every line that is whole. False at its end.
  bool read(int pipe, std::function<void(std::string const& line)> const& take);

  std::string text() const;  ///< the last of them, each with its line end

 private:
  static constexpr std::size_t kLines = 20, kLongest = 500, kUnfinished = 1 << 16;  ///< bytes, of a line

  std::deque<std::string> lines_;
  std::string unfinished_;
};

}  // namespace vitrine::graph
