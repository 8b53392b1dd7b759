// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The verbs of the morning after. Each prints to stdout and returns the exit code.

#include <filesystem>
#include <string>

namespace vitrine::tools {

/// How far the run is, or how the last one ended, and what has failed. 0.
int status(std::filesystem::path const& gallery);

/// What became of the model whose path in the archive is, or alone contains, `model`. 0; 2 where none or several do.
int why(std::filesystem::path const& gallery, std::string const& model);

/// Runs the gallery's last command again, with all that failed. The code of that run.
int retry(std::filesystem::path const& gallery, bool quarantined);

/// Every published file against its hash. 0, or 4 where one is missing or damaged.
int check(std::filesystem::path const& gallery);

}  // namespace vitrine::tools
