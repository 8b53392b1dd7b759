// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What is kept of a model between runs, as bytes: in the ledger, and on the way from the worker to the guard.

#include "graph/report.h"
#include "io/dependencies.h"

#include <map>
#include <optional>
#include <string>

namespace vitrine::graph {

/// By name in the model: what the file system said of the files that were read. "" is the model's own file. Only stamps
/// that are known to be those of the bytes that were read.
using Stamps = std::map<std::string, io::Stamp>;

struct Record {
  ModelRow row;
  std::string settings;  ///< settings_hash
  Stamps stamps;
  std::int64_t since = 0;  ///< of a failure: the start of the run that saw it first, milliseconds since 1970
  std::string evidence;    ///< of a quarantined model: the last lines of the log
};

/// CBOR: exact, also for numbers that JSON does not know and for names that are no UTF-8.
std::string to_bytes(Record const& record);
/// Nothing when these are no record of this version.
std::optional<Record> record_from(std::string const& bytes);

}  // namespace vitrine::graph
