// SPDX-License-Identifier: Apache-2.0
#include "graph/last_lines.h"

#include <unistd.h>

#include <algorithm>

namespace vitrine::graph {

bool LastLines::read(int pipe, std::function<void(std::string const& line)> const& take) {
  char piece[4096];
  ssize_t const count = ::read(pipe, piece, sizeof piece);
  if (count <= 0) return count < 0;
  unfinished_.append(piece, std::size_t(count));
  for (std::size_t end; (end = unfinished_.find('\n')) != std::string::npos; unfinished_.erase(0, end + 1)) {
    lines_.push_back(unfinished_.substr(0, std::min(end, kLongest)));
    if (lines_.size() > kLines) lines_.pop_front();
    take(lines_.back());
  }
  if (unfinished_.size() > kUnfinished) unfinished_.clear();
  return true;
}

std::string LastLines::text() const {
  std::string all;
  for (std::string const& line : lines_) all += line + "\n";
  return all;
}

}  // namespace vitrine::graph
