// SPDX-License-Identifier: Apache-2.0
#include "tools/convert.h"

#include "graph/progress.h"
#include "graph/trace.h"
#include "io/publish.h"
#include "stages/error.h"
#include "tools/command_line.h"
#include "tools/gallery_page.h"
#include "tools/printable.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <thread>

namespace vitrine::tools {
namespace {

namespace fs = std::filesystem;

constexpr int kComplete = 0, kNothingFound = 1, kSomeFailed = 3;

/// Expected time of each model, in any unit: a constant share and one by size.
std::vector<double> costs(io::Archive const& archive) {
  std::vector<double> costs;
  for (io::ArchiveEntry const& entry : archive.entries) costs.push_back(3e5 + double(entry.estimate.triangles));
  return costs;
}

void publish_reports(ConvertCommand const& command, std::vector<graph::ModelRow> const& rows, double seconds) {
  fs::path const& gallery = command.run.gallery;
  std::string const archive = fs::absolute(command.archive).lexically_normal();
  nlohmann::ordered_json report = graph::report_json(rows, archive, graph::options_json(command.model), seconds);
  nlohmann::ordered_json shown = graph::gallery_json(rows);
  report["page"] = shown["page"] = page_weight(gallery, rows, page_sizes());
  report["cpuSeconds"] = graph::cpu_seconds();
  report["peakMemory"] = graph::peak_memory();
  io::publish_file(gallery / "report.json", graph::to_text(report));
  io::publish_file(gallery / "report.csv", graph::report_csv(rows));
  io::publish_file(gallery / "gallery.json", graph::to_text(shown));
}

/// Share of the cores' time that the program computed.
double busy(graph::RunOptions const& run, double seconds) {
  unsigned const all = std::max(std::thread::hardware_concurrency(), 1u);
  unsigned const cores = run.threads > 0 ? std::min(unsigned(run.threads), all) : all;
  return std::min(1.0, graph::cpu_seconds() / (seconds * cores));
}

void print_summary(std::vector<graph::ModelRow> const& rows, graph::RunOptions const& run, double seconds) {
  fs::path const& gallery = run.gallery;
  std::size_t done = 0, bytes = 0;
  for (graph::ModelRow const& row : rows)
    if (row.status == "done") ++done, bytes += row.bytes.total;
  fmt::print("{} of {} models converted in {:.1f} s", done, rows.size(), seconds);
  if (done > 0) fmt::print(", {:.1f} KB each on average", double(bytes) / double(done) / 1000);
  fmt::print("\n");
  if (done < rows.size())
    fmt::print("{} failed: see {}\n", rows.size() - done, printable((gallery / "report.csv").string()));
  fmt::print("cores {:.0f} % busy, at most {:.2f} GB of memory\n", 100 * busy(run, seconds), double(graph::peak_memory()) / 1e9);
  fmt::print("look at it: vitrine serve {}\n", printable(gallery.string()));
}

}  // namespace

int convert(ConvertCommand const& command) {
  auto const start = std::chrono::steady_clock::now();
  io::Archive const archive = io::read_archive(command.archive, command.reading);
  for (std::string const& note : archive.notes) fmt::print(stderr, "note: {}\n", printable(note));
  if (archive.entries.empty()) {
    fmt::print(stderr, "error: no model found below {}; PLY, OBJ, STL, OFF, glTF and GLB files are read\n",
               printable(command.archive.string()));
    return kNothingFound;
  }
  fs::create_directories(command.run.gallery);
  io::sweep_unfinished(command.run.gallery);

  std::vector<double> const cost = costs(archive);
  std::vector<graph::ModelRow> rows;
  {
    double total = 0;
    for (double c : cost) total += c;
    graph::Progress progress(archive.entries.size(), total, isatty(STDERR_FILENO));
    rows = graph::run_pipeline(archive, command.model, command.run, [&](graph::ModelRow const& row, std::size_t entry) {
      progress.finished(cost[entry], row.status != "done");
      if (row.status != "done") progress.say(printable(graph::describe(row)));
    });
  }
  double const seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  publish_reports(command, rows, seconds);
  publish_page(command.run.gallery, rows, command.model.encode.x3dom);
  print_summary(rows, command.run, seconds);
  bool const all = std::all_of(rows.begin(), rows.end(), [](auto const& row) { return row.status == "done"; });
  return all ? kComplete : kSomeFailed;
}

}  // namespace vitrine::tools
