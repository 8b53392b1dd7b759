// SPDX-License-Identifier: Apache-2.0
#include "tools/rehearsal.h"

#include "graph/admission.h"
#include "tools/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

namespace vitrine::tools {
namespace {

/// Seconds of work for a unit of cost (graph::cost): a search over a model of 300,000 triangles takes about 20.
constexpr double kUsualPace = 20.0 / 6e5;

double pace(Rehearsal const& rehearsal, graph::Work const& work) {
  double seconds = 0, cost = 0;
  for (io::ArchiveEntry const& entry : rehearsal.archive.entries) {
    auto const known = work.known.find(entry.slug);
    if (known == work.known.end() || known->second.row.status != "done") continue;
    for (auto const& [stage, spent] : known->second.row.seconds) seconds += spent;
    cost += graph::cost(entry);
  }
  return seconds > 0 ? seconds / cost : kUsualPace;
}

std::string time(double seconds) {
  return seconds < 90     ? fmt::format("{:.0f} s", seconds)
         : seconds < 5400 ? fmt::format("{:.0f} min", seconds / 60)
                          : fmt::format("{:.1f} h", seconds / 3600);
}

}  // namespace

std::string rehearsal_text(Rehearsal const& rehearsal, graph::Work const& work) {
  std::string text;
  double cost = 0;
  std::uint64_t bytes = 0, largest = 0;
  for (io::ArchiveEntry const& entry : rehearsal.archive.entries) {
    auto const todo = rehearsal.todo.find(entry.slug);
    if (todo == rehearsal.todo.end()) continue;
    text += fmt::format("{}: {}\n", printable(entry.path), printable(todo->second));
    cost += graph::cost(entry);
    bytes += entry.bytes;
    largest = std::max(largest, entry.estimate.memory);
  }
  auto const known = std::count_if(rehearsal.fresh.begin(), rehearsal.fresh.end(),
                                   [](auto const& r) { return r.row.status != "done"; });
  std::uint64_t const memory = work.run.memory ? work.run.memory : graph::default_memory();
  unsigned const threads =
      work.run.threads > 0 ? unsigned(work.run.threads) : std::max(1u, std::thread::hardware_concurrency());
  text += fmt::format("{} of {} models would be converted, {} are up to date, {} are known to fail\n",
                      rehearsal.todo.size(), rehearsal.archive.entries.size(),
                      rehearsal.fresh.size() - std::size_t(known), known);
  if (rehearsal.todo.empty()) return text;
  return text + fmt::format(
                    "about {} on {} cores; {:.1f} MB to read; up to {:.1f} MB to write; the largest model takes an "
                    "estimated {:.2f} of {:.2f} GB\n",
                    time(cost * pace(rehearsal, work) / threads), threads, double(bytes) / 1e6,
                    double(rehearsal.todo.size()) * work.model.fit.max_kb / 1000, double(largest) / 1e9,
                    double(memory) / 1e9);
}

}  // namespace vitrine::tools
