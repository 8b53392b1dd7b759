// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Resume is re-run: which of a gallery's models are as today's archive, options and program would make them.

#include "graph/options.h"
#include "graph/record.h"
#include "io/archive.h"

#include <filesystem>
#include <optional>
#include <string>

namespace vitrine::graph {

struct Freshness {
  bool fresh = false;
  std::string why;  ///< "up to date", or what has changed, for people
  Record record;    ///< of a fresh one, with today's metadata and stamps
};

struct FreshnessOptions {
  bool verify = false;  ///< trust no stamp: hash every input again, and every published file
};

/// Looks at one model. `known`: what the ledger holds of it; without it the certificate in its folder is asked. A
/// failure that lies in the model stays one as long as nothing has changed; one that lies in the machine does not.
Freshness freshness(io::ArchiveEntry const& entry, std::optional<Record> const& known, ModelOptions const& options,
                    std::filesystem::path const& gallery, FreshnessOptions const& how);

/// Stamps of the files that a row was made from, as far as they tell of bytes read after `moment`.
Stamps stamps_since(std::chrono::system_clock::time_point moment, io::ArchiveEntry const& entry,
                    io::Dependencies const& dependencies);

/// The record that the folder's certificate holds; nothing where there is none or it is damaged.
std::optional<Record> record_of_certificate(std::filesystem::path const& gallery, std::string const& slug);

/// What is wrong with the files of a finished model: one line for each that is missing or, with `contents`, not what
/// was published.
std::vector<std::string> damage(ModelRow const& row, std::filesystem::path const& gallery, bool contents);

}  // namespace vitrine::graph
