// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The folder of one thumbnail, in the order in which it may be believed: the data, then the certificate.

#include "graph/report.h"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace vitrine::graph {

/// models/<slug> of a gallery while it is being written. Each file appears whole; its hash goes into row.files.
class ModelFolder {
 public:
  /// Takes away the certificate of what was there before: it does not vouch for what comes now.
  ModelFolder(std::filesystem::path const& gallery, ModelRow& row);

  /// `name` within the folder. Errors: those of io::publish_file.
  void write(std::string const& name, std::span<std::byte const> bytes);
  /// Enters a file that somebody else has written into the folder.
  void enter(std::string const& name);
  /// Removes what earlier runs left and this one did not write; fills in the row's paths.
  void settle();
  /// The last file.
  void certify(std::string_view text);

 private:
  std::filesystem::path gallery_;
  std::filesystem::path folder_;  ///< within the gallery
  ModelRow& row_;
};

/// The row's paths, by what was published.
void name_files(ModelRow& row);

}  // namespace vitrine::graph
