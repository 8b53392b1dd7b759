// SPDX-License-Identifier: Apache-2.0
#include "graph/chronicle.h"

#include "graph/work.h"
#include "io/publish.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <ctime>

namespace vitrine::graph {
namespace {

using json = StrictJson;
namespace fs = std::filesystem;

constexpr std::chrono::seconds kPeriod{5};

std::string text_of(json const& value, int indent) {
  return value.dump(indent, ' ', false, json::error_handler_t::replace);
}

}  // namespace

std::string utc(std::int64_t milliseconds) {
  return fmt::format("{:%FT%TZ}", fmt::gmtime(std::time_t(milliseconds / 1000)));
}

Chronicle::Chronicle(Night const& night, fs::path const& gallery, fs::path const& log, bool live)
    : night_(night), gallery_(gallery), live_(live) {
  if (log.empty()) return;
  log_.open(log, std::ios::app);
  if (!log_) throw fs::filesystem_error("cannot write", log, std::make_error_code(std::errc::permission_denied));
}

void Chronicle::event(json const& message) {
  std::string const event = message.value("event", "");
  if (event == "stage") stages_[message.value("slug", "")] = message.value("stage", "");
  if (event == "todo") stages_.erase(message.value("slug", ""));
  if (event == "archive" || event == "converting" || event == "died") stages_.clear();
  if (!log_.is_open() || message.contains("record")) return;  // records are told of when they are settled
  json line = {{"time", utc(1000 * std::int64_t(std::time(nullptr)))}};
  line.update(message);
  if (event == "archive") line["entries"] = message.at("entries").size();
  log_ << text_of(line, -1) << std::endl;
}

void Chronicle::say(std::string const& line) {
  if (progress_)
    progress_->say(line);
  else
    fmt::print(stderr, "{}\n", line);
}

/// Nothing where the model has left the archive since.
double Chronicle::cost_of(std::string const& slug) const {
  io::ArchiveEntry const* const entry = night_.entry(slug);
  return entry ? cost(*entry) : 0;
}

void Chronicle::converting() {
  double total = 0;
  for (auto const& [slug, why] : night_.todo()) total += cost_of(slug);
  if (!night_.todo().empty()) progress_.emplace(night_.todo().size(), total, live_);
  write_status("running");
}

void Chronicle::left(Record const& record) {
  ModelRow const& row = record.row;
  bool const failed = row.status != "done";
  stages_.erase(row.slug);
  if (progress_) progress_->finished(cost_of(row.slug), failed);
  if (!log_.is_open()) return;
  json line = {{"time", utc(1000 * std::int64_t(std::time(nullptr)))},
               {"event", row.status},
               {"model", row.input},
               {"bytes", row.bytes.total}};
  if (failed)
    line.update({{"stage", row.failure.stage}, {"reason", row.failure.reason}, {"remedy", row.failure.remedy}});
  log_ << text_of(line, -1) << std::endl;
}

void Chronicle::tick() {
  if (std::chrono::steady_clock::now() - written_ >= kPeriod) write_status("running");
}

void Chronicle::end(std::string const& state) {
  progress_.reset();
  stages_.clear();
  write_status(state);
}

json Chronicle::status(std::string const& state) const {
  auto const& records = night_.records();
  auto const failed = std::count_if(records.begin(), records.end(),
                                    [](auto const& known) { return known.second.row.status != "done"; });
  json under_way = json::array();
  for (auto const& [slug, stage] : stages_)
    if (io::ArchiveEntry const* const entry = night_.entry(slug))
      under_way.push_back({{"model", entry->path}, {"stage", stage}});
  std::chrono::duration<double> const elapsed = std::chrono::steady_clock::now() - start_;
  return {{"schema", 1},
          {"state", state},
          {"process", ::getpid()},
          {"started", utc(night_.started())},
          {"updated", utc(1000 * std::int64_t(std::time(nullptr)))},
          {"seconds", elapsed.count()},
          {"models", night_.archive().entries.size()},
          {"settled", records.size()},
          {"converted", night_.converted().size()},
          {"failed", failed},
          {"underWay", under_way}};
}

/// A status that cannot be written must not end the run: the disk is watched elsewhere.
void Chronicle::write_status(std::string const& state) {
  written_ = std::chrono::steady_clock::now();
  try {
    io::publish_file(gallery_ / ".vitrine/status.json", text_of(status(state), 1) + "\n");
  } catch (fs::filesystem_error const&) {
  }
}

}  // namespace vitrine::graph
