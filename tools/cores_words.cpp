// SPDX-License-Identifier: Apache-2.0
#include "tools/cores_words.h"

#include "tools/report/escape.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace vitrine::tools {
namespace {

using graph::Bound;
using graph::Occupancy;
using graph::StageProfile;

constexpr std::size_t kShown = 5;  ///< stages in one line

std::string percent(double share) { return fmt::format("{:.0f} %", 100 * share); }
std::string gigabytes(std::uint64_t bytes) { return fmt::format("{:.2f} GB", double(bytes) / 1e9); }

std::string limit(Occupancy const& o) {
  switch (graph::bound(o)) {
    case Bound::nothing:
      return "bound by nothing";
    case Bound::cores:
      return "bound by the cores";
    case Bound::memory:
      return "bound by memory, of which --memory allows " + gigabytes(o.allowed);
    case Bound::reading:
      return fmt::format("bound by reading, {} at {:.0f} MB/s", gigabytes(o.disk_bytes),
                         double(o.disk_bytes) / 1e6 / o.seconds);
    case Bound::writing:
      return "bound by writing to the gallery";
    case Bound::ending:
      return "bound by its last models";
    case Bound::within:
      return "bound by steps that no other core could share";
  }
  return "";
}

std::string idle_words(Occupancy const& o) {
  std::array<std::pair<double, char const*>, 5> reasons{{{o.memory, "models waited for memory"},
                                                         {o.reading, "reading"},
                                                         {o.writing, "writing"},
                                                         {o.ending, "no further model to begin"},
                                                         {o.within, "steps that no other core could share"}}};
  std::stable_sort(reasons.begin(), reasons.end(), [](auto const& a, auto const& b) { return a.first > b.first; });
  double all = 0;
  std::string words;
  for (auto const& [seconds, why] : reasons) {
    all += seconds;
    if (seconds / o.available >= 0.005)
      words += (words.empty() ? "" : ", ") + percent(seconds / o.available) + " " + why;
  }
  return percent(all / o.available) + " idle" + (words.empty() ? "" : " (" + words + ")");
}

}  // namespace

std::string cores_words(Occupancy const& o) {
  if (graph::bound(o) == Bound::nothing) return limit(o);
  std::string text = limit(o) + ": " + percent(o.computed / o.available) + " computing, " + idle_words(o);
  if (o.taken / o.available >= 0.005) text += ", " + percent(o.taken / o.available) + " taken by other programs";
  return text;
}

std::string memory_words(Occupancy const& o) {
  return fmt::format("memory: at most {} held, where {} were estimated; {} allowed", gigabytes(o.peak),
                     gigabytes(o.admitted), gigabytes(o.allowed));
}

std::string stages_words(std::vector<StageProfile> stages) {
  std::stable_sort(stages.begin(), stages.end(), [](auto const& a, auto const& b) { return a.share > b.share; });
  std::string text = "time:";
  double others = 1;
  for (std::size_t i = 0; i < std::min(kShown, stages.size()); ++i) {
    text += fmt::format("{} {} {}", i ? "," : "", stages[i].stage, percent(stages[i].share));
    others -= stages[i].share;
  }
  return stages.size() > kShown ? text + ", others " + percent(others) : text;
}

std::string stages_html(std::vector<StageProfile> const& stages) {
  if (stages.empty()) return "";
  std::string out = "<h2>Stages</h2>\n<table><tr><th>Stage</th>";
  for (char const* title : {"Models", "Time", "Share", "Waiting", "Peak memory"})
    out += fmt::format("<th class=\"number\">{}</th>", title);
  out += "</tr>\n";
  for (StageProfile const& s : stages) {
    out += "<tr><td>" + report::html(s.stage) + "</td>";
    for (std::string const& cell : {std::to_string(s.models), fmt::format("{:.2f} s", s.seconds), percent(s.share),
                                    fmt::format("{:.2f} s", s.waiting), gigabytes(s.peak_memory)})
      out += "<td class=\"number\">" + cell + "</td>";
    out += "</tr>\n";
  }
  return out +
         "</table>\n<p class=\"quiet\">Of what this run converted. Waiting: of models for their stage. "
         "Peak memory: of the whole program while the stage ran for any model.</p>\n";
}

}  // namespace vitrine::tools
