// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Folders and files that tests make and leave no trace of.

#include "stages/data.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace vitrine::test {

/// An empty folder of its own, removed with everything in it.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(TemporaryFolder const&) = delete;
  TemporaryFolder& operator=(TemporaryFolder const&) = delete;
  std::filesystem::path const& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

void write_file(std::filesystem::path const& path, std::string_view text);  ///< makes its folder
std::string read_file(std::filesystem::path const& path);                   ///< "" when missing

/// Positions, colours (as sRGB 0..1) and faces as OBJ.
std::string obj_text(SourceModel const& model);

/// Real models beside the repository (20 whole ones; `broken` below it), or an empty path where there are none.
std::filesystem::path shared_models();

/// A manifest's rows as text cells, without its header.
std::vector<std::vector<std::string>> manifest(std::filesystem::path const& tsv);

}  // namespace vitrine::test
