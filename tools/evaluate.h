// SPDX-License-Identifier: Apache-2.0
#pragma once
/// vitrine evaluate: how good any tool's thumbnail is.

#include "io/archive.h"
#include "io/read_model.h"
#include "stages/measure.h"

#include <filesystem>

namespace vitrine::tools {

struct EvaluateCommand {
  std::filesystem::path original;   ///< any format that is read
  std::filesystem::path thumbnail;  ///< GLB
  io::ReadOptions read;
  io::UpAxis up = io::UpAxis::y;  ///< of the original; the thumbnail is +Y up, as glTF says
  MeasureOptions measure;
  bool json = false;            ///< everything, with each view's figures and camera, instead of a table
  std::filesystem::path sheet;  ///< PNG of all views side by side; empty: none
};

/// Prints the figures on stdout, writes the sheet. The thumbnail is drawn as it is: nothing is repaired.
/// Errors: those of the readers, naming the file; InvalidInput for a thumbnail that cannot be drawn.
int evaluate(EvaluateCommand const& command);

}  // namespace vitrine::tools
