// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The books of one run: what was found, what became of it, and what the ledger remembers for the next.

#include "graph/record.h"
#include "io/archive.h"
#include "io/ledger.h"

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace vitrine::graph {

/// What `retry` takes up again although nothing has changed.
enum class Retry { nothing, failed, quarantined };

class Night {
 public:
  /// Opens the gallery's ledger. Errors: those of io::Ledger.
  explicit Night(std::filesystem::path const& gallery);

  /// Forgets failures, so that they are tried again.
  void forget(Retry what);
  std::map<std::string, Record> const& known() const { return known_; }

  void found(io::Archive archive);
  io::Archive const& archive() const { return archive_; }
  io::ArchiveEntry const* entry(std::string const& slug) const;

  /// Up to date since an earlier run.
  void fresh(Record record);
  /// Out of this run. What lies in the machine is no reason to remember it.
  void finished(Record record);
  /// To be converted, and why.
  void todo(std::string const& slug, std::string const& why) { todo_[slug] = why; }
  std::map<std::string, std::string> const& todo() const { return todo_; }

  bool settled(std::string const& slug) const { return records_.contains(slug); }
  std::set<std::string> settled() const;
  bool complete() const { return records_.size() >= archive_.entries.size(); }

  /// One per entry, in the archive's order; what was not reached is pending.
  std::vector<ModelRow> rows() const;
  std::map<std::string, Record> const& records() const { return records_; }
  std::set<std::string> const& converted() const { return converted_; }  ///< slugs that this run has worked on
  std::int64_t started() const { return started_; }                      ///< milliseconds since 1970

  /// Folders in models/ that belong to no model of the archive.
  std::vector<std::string> orphans() const;

 private:
  void keep(Record record);

  std::filesystem::path gallery_;
  io::Ledger ledger_;
  std::int64_t started_;
  io::Archive archive_;
  std::map<std::string, std::size_t> places_;  ///< in the archive, by slug
  std::map<std::string, Record> known_, forgotten_, records_;
  std::map<std::string, std::string> todo_, kept_;
  std::set<std::string> converted_;
};

/// What the ledger of a gallery holds; also while a run is under way.
std::map<std::string, Record> recorded(std::filesystem::path const& gallery);

std::filesystem::path ledger_file(std::filesystem::path const& gallery);
std::filesystem::path lock_file(std::filesystem::path const& gallery);

}  // namespace vitrine::graph
