// SPDX-License-Identifier: Apache-2.0
#include "graph/freshness.h"

#include "graph/arrival.h"
#include "graph/certificate.h"
#include "graph/settings.h"
#include "stages/error.h"

namespace vitrine::graph {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::system_clock;

/// Where a name of the model leads today; refused names lead nowhere.
std::optional<fs::path> found_today(io::ArchiveEntry const& entry, std::string const& name) {
  try {
    return name.empty() ? std::optional(entry.file) : io::find_in(entry.file.parent_path(), name);
  } catch (Error const&) {
    return std::nullopt;
  } catch (fs::filesystem_error const&) {
    return std::nullopt;
  }
}

/// Compares the files that a record was made from with today's; takes over stamps where the bytes are the same.
class Inputs {
 public:
  Inputs(io::ArchiveEntry const& entry, Record& record, bool verify)
      : entry_(entry), record_(record), verify_(verify) {}

  /// What has changed; "" if nothing.
  std::string changes() {
    if (!same("", record_.row.input_hash)) return "the model's file has changed";
    for (auto const& [name, hash] : record_.row.dependencies)
      if (!same(name, hash)) return name + (hash.empty() ? " was missing and is there now" : " has changed");
    return {};
  }

 private:
  bool same(std::string const& name, std::string const& hash) {
    std::optional<fs::path> const file = found_today(entry_, name);
    if (!file || hash.empty()) return !file && hash.empty();
    std::optional<io::Stamp> const today = io::stamp(*file);
    auto const stamped = record_.stamps.find(name);
    if (!verify_ && today && stamped != record_.stamps.end() && stamped->second == *today) return true;
    Clock::time_point const now = Clock::now();
    if (io::file_hash(*file) != hash) return false;
    record_.stamps.erase(name);
    if (today && io::settled(*today, now) && io::stamp(*file) == today) record_.stamps[name] = *today;
    return true;
  }

  io::ArchiveEntry const& entry_;
  Record& record_;
  bool verify_;
};

}  // namespace

Stamps stamps_since(Clock::time_point moment, io::ArchiveEntry const& entry, io::Dependencies const& dependencies) {
  Stamps stamps;
  auto const add = [&](std::string const& name) {
    std::optional<fs::path> const file = found_today(entry, name);
    std::optional<io::Stamp> const today = file ? io::stamp(*file) : std::nullopt;
    if (today && io::settled(*today, moment)) stamps[name] = *today;
  };
  add("");
  for (auto const& [name, hash] : dependencies)
    if (!hash.empty()) add(name);
  return stamps;
}

std::optional<Record> record_of_certificate(fs::path const& gallery, std::string const& slug) try {
  return record_from_certificate(std::string(io::text(io::map_file(gallery / "models" / slug / "certificate.json"))),
                                 slug);
} catch (Error const&) {
  return std::nullopt;
} catch (fs::filesystem_error const&) {
  return std::nullopt;
}

std::vector<std::string> damage(ModelRow const& row, fs::path const& gallery, bool contents) {
  std::vector<std::string> lines;
  for (auto const& [path, hash] : row.files) {
    std::error_code error;
    if (!fs::is_regular_file(gallery / path, error))
      lines.push_back(path + " is missing");
    else if (contents && io::file_hash(gallery / path) != hash)
      lines.push_back(path + " is not what was published");
  }
  return lines;
}

Freshness freshness(io::ArchiveEntry const& entry, std::optional<Record> const& known, ModelOptions const& options,
                    fs::path const& gallery, FreshnessOptions const& how) {
  std::optional<Record> record = known ? known : record_of_certificate(gallery, entry.slug);
  if (!record) return {false, "never converted", {}};
  ModelRow& row = record->row;
  if (row.status == "failed" && row.failure.cause != Cause::model)
    return {false, "failed for a reason that lies in the machine", {}};
  if (record->settings != settings_hash(options, title_of(entry), entry.up))
    return {false, "the options, the title, the up axis or the program have changed", {}};
  if (std::string const change = Inputs(entry, *record, how.verify).changes(); !change.empty())
    return {false, change, {}};
  if (std::vector<std::string> const bad = damage(row, gallery, how.verify); !bad.empty())
    return {false, bad.front(), {}};
  refresh(row, entry, options.cluster);
  return {true, row.status == "done" ? "up to date" : "known: " + row.failure.reason, std::move(*record)};
}

}  // namespace vitrine::graph
