// SPDX-License-Identifier: Apache-2.0
#include "graph/summary.h"

#include "graph/chronicle.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <numeric>
#include <string_view>

namespace vitrine::graph {
namespace {

using json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr std::size_t kSlowest = 10;
constexpr std::string_view kNumber = "…";

double seconds_of(ModelRow const& row) {
  return std::accumulate(row.seconds.begin(), row.seconds.end(), 0.0,
                         [](double s, auto const& t) { return s + t.second; });
}

/// Most first; of equal ones by name.
template <class Value>
std::vector<std::pair<std::string, Value>> sorted(std::map<std::string, Value> const& counts) {
  std::vector<std::pair<std::string, Value>> all(counts.begin(), counts.end());
  std::stable_sort(all.begin(), all.end(), [](auto const& a, auto const& b) { return a.second > b.second; });
  return all;
}

std::uint64_t disk_used(std::vector<ModelRow> const& rows, fs::path const& gallery) {
  std::uint64_t sum = 0;
  std::error_code error;
  for (ModelRow const& row : rows)
    for (auto const& [path, hash] : row.files)
      if (std::uintmax_t const size = fs::file_size(gallery / path, error); !error) sum += size;
  return sum;
}

void count_repairs(Repairs const& repairs, std::map<std::string, std::uint64_t>& sums) {
  json const all = repairs_json(repairs);  // items() only refers to it
  for (auto const& [kind, count] : all.items())
    if (std::uint64_t const n = count; n > 0) sums[kind] += n;
}

/// Without its numbers: what ended many models is one reason, wherever in each of them it was.
std::string kind_of(std::string const& reason) {
  std::string kind;
  for (std::size_t i = 0; i < reason.size(); ++i) {
    bool const digit = reason[i] >= '0' && reason[i] <= '9';
    // "glTF2" stays, and the rest of a number goes
    bool const inside = i > 0 && std::isalnum(static_cast<unsigned char>(reason[i - 1]));
    if (!digit || (inside && !kind.ends_with(kNumber)))
      kind += reason[i];
    else if (!kind.ends_with(kNumber))
      kind += kNumber;
  }
  return kind;
}

}  // namespace

Summary summarise(Night const& night, GuardReport const& guard, double seconds, fs::path const& gallery) {
  Summary summary;
  std::vector<ModelRow> const rows = night.rows();
  std::map<std::string, std::size_t> reasons;
  std::map<std::string, double> times;
  std::map<std::string, std::uint64_t> repairs;
  Profile profile;
  summary.models = rows.size();
  for (ModelRow const& row : rows) {
    bool const now = night.converted().contains(row.slug);
    summary.done += row.status == "done";
    summary.failed += row.status == "failed";
    summary.quarantined += row.status == "quarantined";
    summary.pending += row.status == "pending";
    summary.converted += now;
    summary.up_to_date += !now && row.status == "done";
    summary.bytes += row.bytes.total;
    if (now) times[row.input] = seconds_of(row), profile.add(row);
    count_repairs(row.repairs, repairs);
    if (row.status != "failed" && row.status != "quarantined") continue;
    ++reasons[row.failure.stage + ": " + kind_of(row.failure.reason)];
    bool const is_new = night.records().at(row.slug).since >= night.started();
    summary.problems.push_back(
        {row.input, row.status, row.failure.stage, row.failure.reason, row.failure.remedy, is_new});
  }
  summary.reasons = sorted(reasons);
  summary.slowest = sorted(times);
  summary.slowest.resize(std::min(summary.slowest.size(), kSlowest));
  summary.repairs = sorted(repairs);
  summary.stages = profile.stages();
  summary.disk = disk_used(rows, gallery);
  summary.orphans = night.orphans();
  summary.seconds = seconds;
  summary.guard = guard;
  if (summary.failed + summary.quarantined > 0)
    summary.retry = "vitrine retry " + std::string(summary.quarantined > 0 ? "--quarantined " : "") + gallery.string();
  return summary;
}

namespace {

/// Core-seconds, but `seconds`.
json cores_json(Occupancy const& o) {
  return {{"seconds", o.seconds},
          {"available", o.available},
          {"computed", o.computed},
          {"taken", o.taken},
          {"idle",
           {{"memory", o.memory},
            {"reading", o.reading},
            {"writing", o.writing},
            {"ending", o.ending},
            {"within", o.within}}}};
}

json memory_json(Occupancy const& o) {
  return {{"peak", o.peak}, {"admittedAtPeak", o.admitted}, {"mostAdmitted", o.most_admitted}, {"allowed", o.allowed}};
}

}  // namespace

json run_json(Summary const& s) {
  json slowest = json::array(), fresh = json::array(), known = json::array();
  for (auto const& [input, seconds] : s.slowest) slowest.push_back({{"input", input}, {"seconds", seconds}});
  for (Summary::Problem const& problem : s.problems) (problem.is_new ? fresh : known).push_back(problem.input);
  return {{"seconds", s.seconds},
          {"converted", s.converted},
          {"upToDate", s.up_to_date},
          {"newFailures", fresh},
          {"knownFailures", known},
          {"slowest", slowest},
          {"workers", s.guard.workers},
          {"confinement", s.guard.confinement},
          {"bound", shown(bound(s.guard.occupancy))},
          {"cores", cores_json(s.guard.occupancy)},
          {"memory", memory_json(s.guard.occupancy)},
          {"diskBytes", s.guard.occupancy.disk_bytes},
          {"unprotected", s.guard.missing},
          {"ending", s.guard.reason.empty() ? "complete" : s.guard.reason}};
}

}  // namespace vitrine::graph
