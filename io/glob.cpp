// SPDX-License-Identifier: Apache-2.0
#include "io/glob.h"

#include <string_view>
#include <vector>

namespace vitrine::io {
namespace {

bool is_slash(char c) { return c == '/'; }

}  // namespace

/// Keeps, for the part of the pattern read so far, the set of places in the path that it may have reached:
/// pattern length x path length steps, whatever the stars.
bool matches_glob(std::string_view pattern, std::string_view path) {
  std::size_t const n = path.size();
  std::vector<char> reached(n + 1, 0);
  reached[0] = 1;
  while (!pattern.empty()) {
    std::vector<char> next(n + 1, 0);
    if (pattern.starts_with("**/")) {
      bool inside = false;  // of a run of folders that began where the pattern had come to
      for (std::size_t i = 0; i <= n; ++i) {
        next[i] = reached[i] || (inside && is_slash(path[i - 1]));
        inside = inside || reached[i];
      }
      pattern.remove_prefix(3);
    } else if (pattern.starts_with("*")) {
      bool const across = pattern.starts_with("**");
      for (std::size_t i = 0; i <= n; ++i)
        next[i] = reached[i] || (i > 0 && next[i - 1] && (across || !is_slash(path[i - 1])));
      pattern.remove_prefix(across ? 2 : 1);
    } else {
      for (std::size_t i = 0; i < n; ++i)
        next[i + 1] = reached[i] && (pattern[0] == '?' ? !is_slash(path[i]) : pattern[0] == path[i]);
      pattern.remove_prefix(1);
    }
    reached = std::move(next);
  }
  return reached[n];
}

}  // namespace vitrine::io
