// SPDX-License-Identifier: Apache-2.0
#include "graph/night.h"

#include "graph/arrival.h"
#include "io/fault.h"

#include <algorithm>
#include <chrono>

namespace vitrine::graph {
namespace {

namespace fs = std::filesystem;

std::int64_t now() {
  return std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::system_clock::now().time_since_epoch())
      .count();
}

std::map<std::string, Record> decoded(std::map<std::string, std::string> const& entries) {
  std::map<std::string, Record> records;
  for (auto const& [slug, bytes] : entries)
    if (std::optional<Record> record = record_from(bytes)) records.emplace(slug, std::move(*record));
  return records;
}

/// An entry that the run has not come to.
ModelRow pending(io::ArchiveEntry const& entry) {
  ModelRow row = arriving(entry, {});
  row.status = "pending";
  row.failure = {"admit", "the run was stopped before its turn", "run the same command again", Cause::stopped};
  return row;
}

}  // namespace

fs::path ledger_file(fs::path const& gallery) { return gallery / ".vitrine/ledger.sqlite"; }
fs::path lock_file(fs::path const& gallery) { return gallery / ".vitrine/lock"; }

std::map<std::string, Record> recorded(fs::path const& gallery) {
  return decoded(io::read_ledger(ledger_file(gallery)));
}

Night::Night(fs::path const& gallery)
    : gallery_(gallery), ledger_(ledger_file(gallery)), started_(now()), kept_(ledger_.entries()) {
  known_ = decoded(kept_);
}

void Night::forget(Retry what) {
  for (auto it = known_.begin(); it != known_.end();) {
    std::string const& status = it->second.row.status;
    bool const wanted =
        what != Retry::nothing && (status == "failed" || (status == "quarantined" && what == Retry::quarantined));
    auto const next = std::next(it);
    if (wanted) forgotten_.insert(known_.extract(it));
    it = next;
  }
}

void Night::found(io::Archive archive) {
  archive_ = std::move(archive);
  places_.clear();
  for (std::size_t i = 0; i < archive_.entries.size(); ++i) places_[archive_.entries[i].slug] = i;
}

io::ArchiveEntry const* Night::entry(std::string const& slug) const {
  auto const place = places_.find(slug);
  return place == places_.end() ? nullptr : &archive_.entries[place->second];
}

/// Into the ledger, unless it says so already.
void Night::keep(Record record) {
  std::string const slug = record.row.slug;
  std::string bytes = to_bytes(record);
  if (kept_[slug] != bytes) {
    io::fault("ledger:before");
    ledger_.put(slug, bytes);
    io::fault("ledger:after");
  }
  kept_[slug] = std::move(bytes);
  records_[slug] = std::move(record);
}

void Night::fresh(Record record) { keep(std::move(record)); }

void Night::finished(Record record) {
  converted_.insert(record.row.slug);
  if (record.row.status == "done") return keep(std::move(record));
  if (record.row.failure.cause == Cause::stopped || record.row.failure.cause == Cause::disk) return;
  record.since = started_;
  for (auto const* earlier : {&known_, &forgotten_})
    if (auto const before = earlier->find(record.row.slug); before != earlier->end() && before->second.since > 0)
      record.since = before->second.since;
  keep(std::move(record));
}

std::set<std::string> Night::settled() const {
  std::set<std::string> slugs;
  for (auto const& [slug, record] : records_) slugs.insert(slug);
  return slugs;
}

std::vector<ModelRow> Night::rows() const {
  std::vector<ModelRow> rows;
  for (io::ArchiveEntry const& entry : archive_.entries) {
    auto const found = records_.find(entry.slug);
    rows.push_back(found == records_.end() ? pending(entry) : found->second.row);
  }
  return rows;
}

std::vector<std::string> Night::orphans() const {
  std::set<std::string> slugs;
  for (io::ArchiveEntry const& entry : archive_.entries) slugs.insert(entry.slug);
  std::vector<std::string> found;
  std::error_code error;
  for (fs::directory_iterator it(gallery_ / "models", error), end; !error && it != end; it.increment(error))
    if (!slugs.contains(it->path().filename())) found.push_back(it->path().filename());
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace vitrine::graph
