// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Models that the command line names.

#include "io/read_model.h"
#include "stages/error.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>

namespace vitrine::tools {

/// Errors of `make` with the file's name in front.
template <class Make>
auto of_file(std::filesystem::path const& file, Make const& make) {
  try {
    return make();
  } catch (Error const& e) {
    throw Error(e.kind(), file.string() + ": " + e.what(), e.remedy());
  }
}

/// ".ply" of "scan.PLY".
inline std::string lower_ending(std::filesystem::path const& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return ending;
}

inline SourceModel read_file(std::filesystem::path const& file, io::ReadOptions const& options) {
  return io::read_model(lower_ending(file), io::map_file(file), io::resolve_in(file.parent_path()), options);
}

}  // namespace vitrine::tools
