// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The command line's side of graph::ModelOptions.

#include "graph/options.h"

#include <CLI/CLI.hpp>

namespace vitrine::tools {

/// Adds --preset and a flag for each field of each group. Flags that are given win over the preset, wherever they
/// stand.
void add_model_flags(CLI::App& app, graph::ModelOptions& options);

}  // namespace vitrine::tools
