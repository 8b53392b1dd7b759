// SPDX-License-Identifier: Apache-2.0
#pragma once
/// vitrine report: the paper's tables and figures for the models of a gallery.

#include "graph/pipeline.h"

#include <filesystem>
#include <vector>

namespace vitrine::report {

struct ReportCommand {
  std::filesystem::path gallery;
  std::filesystem::path archive;  ///< where the originals are; empty: where the gallery's report says
  std::vector<int> textures{64, 128, 256, 512};
  bool ablation = false;  ///< also what each choice of the search is worth
  graph::RunOptions run;  ///< its gallery is not used
};

/// Writes GALLERY/paper.html and GALLERY/paper/. Errors: those of read_gallery and originals.
int report(ReportCommand const& command);

}  // namespace vitrine::report
