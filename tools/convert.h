// SPDX-License-Identifier: Apache-2.0
#pragma once
/// vitrine convert: an archive in, a gallery out.

#include "graph/night.h"
#include "graph/pipeline.h"
#include "io/archive.h"

#include <filesystem>
#include <string>

namespace vitrine::tools {

struct ConvertCommand {
  std::filesystem::path archive;
  io::ArchiveOptions reading;
  graph::ModelOptions model;
  graph::RunOptions run;
  bool verify = false;   ///< look at all bytes, of originals and of thumbnails, not only at times of change
  bool dry_run = false;  ///< say what would be done
  bool prune = false;    ///< remove folders of models that are no longer in the archive
  graph::Retry retry = graph::Retry::nothing;
  double stall_limit = 0;  ///< seconds; 0: by each model's size
  std::string stop_at;     ///< HH:MM; "": never
  std::filesystem::path log;
};

/// Runs it, with progress on stderr and a summary on stdout; writes the reports and the page.
/// Returns the exit code, see docs/night.md.
int convert(ConvertCommand const& command);

}  // namespace vitrine::tools
