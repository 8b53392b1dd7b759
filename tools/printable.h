// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Names of files and what files say are data: control characters must not reach a terminal.

#include <algorithm>
#include <string>

namespace vitrine::tools {

inline std::string printable(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, '?');
  return text;
}

/// The same of several lines, whose ends stay.
inline std::string printable_lines(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return (c < 0x20 && c != '\n') || c == 0x7f; }, '?');
  return text;
}

}  // namespace vitrine::tools
