// SPDX-License-Identifier: Apache-2.0
#pragma once
/// vitrine convert: an archive in, a gallery out.

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
};

/// Runs it, with progress on stderr and a summary on stdout; writes the reports and the page.
/// Returns the exit code: 0 all converted, 1 nothing to convert, 3 some models failed.
int convert(ConvertCommand const& command);

}  // namespace vitrine::tools
