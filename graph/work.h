// SPDX-License-Identifier: Apache-2.0
#pragma once
/// One pass over an archive: what is up to date is passed over, the rest converted. It knows no ledger and no
/// processes.

#include "graph/freshness.h"
#include "graph/options.h"
#include "graph/record.h"
#include "io/archive.h"

#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>

namespace vitrine::graph {

struct Work {
  std::filesystem::path archive;
  io::ArchiveOptions reading;
  ModelOptions model;
  RunOptions run;
  FreshnessOptions freshness;
  std::map<std::string, Record> known;  ///< by slug, what earlier runs have left
  std::set<std::string> settled;        ///< slugs that need no look
  std::set<std::string> unopened;       ///< slugs of which not even the header is to be read
  std::set<std::string> only;           ///< slugs to convert, none else; empty: all
  bool dry = false;                     ///< look, but convert nothing
};

/// What is heard of the work; from one thread at a time.
struct WorkEvents {
  std::function<void(io::Archive const&)> archive;
  std::function<void(std::string const& slug, std::string const& stage)> stage;  ///< a model enters a stage
  std::function<void(Record const&)> fresh;                                      ///< up to date, or known to fail
  std::function<void(std::string const& slug, std::string const& why)> todo;     ///< it will be converted
  std::function<void()> converting;                                              ///< all have been looked at
  std::function<void(Occupancy const& since_the_last)> occupied;                 ///< what the cores did
  std::function<void(Record const&)> finished;                                   ///< converted, or failed
};

/// Errors: those of io::read_archive.
void do_work(Work const& work, WorkEvents const& events);

/// Expected time of a model, in any unit: a constant share and one by size.
double cost(io::ArchiveEntry const& entry);

}  // namespace vitrine::graph
