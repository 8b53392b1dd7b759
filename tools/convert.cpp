// SPDX-License-Identifier: Apache-2.0
#include "tools/convert.h"

#include "graph/chronicle.h"
#include "graph/guard.h"
#include "graph/summary.h"
#include "graph/trace.h"
#include "graph/work.h"
#include "graph/worker.h"
#include "io/fault.h"
#include "io/lock.h"
#include "io/publish.h"
#include "tools/command_line.h"
#include "tools/command_memory.h"
#include "tools/gallery_page.h"
#include "tools/morning.h"
#include "tools/plain_page.h"
#include "tools/printable.h"
#include "tools/rehearsal.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>

namespace vitrine::tools {
namespace {

namespace fs = std::filesystem;

constexpr int kComplete = 0, kFatal = 1, kSomeFailed = 3, kDiskFull = 5, kMachine = 6, kBusy = 11, kInterrupted = 75;

constexpr std::chrono::seconds kFollows{3};  ///< a worker whose guard was killed takes to be gone

/// What the command asks for; whoever does the work adds what is known.
graph::Work work_of(ConvertCommand const& command) {
  graph::Work work;
  work.archive = command.archive;
  work.reading = command.reading;
  work.model = command.model;
  work.run = command.run;
  work.freshness.verify = command.verify;
  work.dry = command.dry_run;
  return work;
}

graph::GuardOptions guard_options(ConvertCommand const& command, io::Lock const& lock) {
  graph::GuardOptions options;
  options.arguments = command_line();
  options.lock = lock.descriptor();
  options.gallery = command.run.gallery;
  options.model = command.model;
  options.memory = command.run.memory;
  options.stall_limit = command.stall_limit;
  if (!command.stop_at.empty()) options.stop_at = next_time(command.stop_at, std::time(nullptr));
  return options;
}

/// Runs the guard and lets everybody follow it.
graph::GuardReport watch_over(graph::Night& night, ConvertCommand const& command, io::Lock const& lock) {
  graph::Chronicle chronicle(night, command.run.gallery, command.log, isatty(STDERR_FILENO));
  graph::GuardListener listener;
  listener.event = [&](graph::StrictJson const& message) { chronicle.event(message); };
  listener.say = [&](std::string const& line) { chronicle.say(printable(line)); };
  listener.converting = [&] { chronicle.converting(); };
  listener.left = [&](graph::Record const& record) {
    chronicle.left(record);
    if (record.row.status != "done") chronicle.say(printable(graph::describe(record.row)));
  };
  listener.tick = [&] { chronicle.tick(); };
  graph::GuardReport const report = graph::guard(night, guard_options(command, lock), listener);
  chronicle.end(report.ending == graph::Ending::complete ? "complete" : "stopped");
  return report;
}

void publish_reports(ConvertCommand const& command, graph::Night const& night, graph::Summary const& summary) {
  fs::path const& gallery = command.run.gallery;
  std::vector<graph::ModelRow> const rows = night.rows();
  std::string const archive = fs::absolute(command.archive).lexically_normal();
  nlohmann::ordered_json report =
      graph::report_json(rows, archive, graph::options_json(command.model), summary.seconds);
  report["run"] = graph::run_json(summary);
  nlohmann::ordered_json shown = graph::gallery_json(rows);
  shown["page"] = page_weight(gallery, rows, command.model.encode.profile, page_sizes());
  offer_plain(gallery, shown);
  keep_measured(gallery, shown["page"]);
  report["page"] = shown["page"];
  report["cpuSeconds"] = graph::cpu_seconds();
  report["peakMemory"] = graph::peak_memory();
  io::fault("reports:before");
  io::publish_file(gallery / "report.json", graph::to_text(report));
  io::fault("reports:between");
  io::publish_file(gallery / "report.csv", graph::report_csv(rows));
  io::publish_file(gallery / "report.html", summary_html(summary, rows));
  io::publish_file(gallery / "gallery.json", graph::to_text(shown));
}

void prune(graph::Night const& night, fs::path const& gallery) {
  for (std::string const& slug : night.orphans()) fs::remove_all(gallery / "models" / slug);
}

int exit_code(graph::Night const& night, graph::GuardReport const& report) {
  bool const found = !night.archive().entries.empty();
  switch (report.ending) {
    case graph::Ending::complete:
      if (!found) return kFatal;
      break;
    case graph::Ending::interrupted:
      return found && night.complete() ? kComplete : kInterrupted;
    case graph::Ending::disk:
      return kDiskFull;
    case graph::Ending::machine:
      return kMachine;
    case graph::Ending::refused:
      return kFatal;
  }
  int code = kComplete;
  for (graph::ModelRow const& row : night.rows())
    if (row.status != "done")
      code = std::max(code, row.failure.cause == graph::Cause::machine ? kMachine : kSomeFailed);
  return code;
}

/// Says why there is nothing to report on.
void refuse(ConvertCommand const& command, graph::GuardReport const& report) {
  if (!report.reason.empty())
    fmt::print(stderr, "error: {}\n", printable(report.reason));
  else
    fmt::print(stderr, "error: no model found below {}; PLY, OBJ, STL, OFF, glTF and GLB files are read\n",
               printable(command.archive.string()));
}

/// One run, from the lock to the summary.
int run(ConvertCommand const& command) {
  auto const start = std::chrono::steady_clock::now();
  fs::path const& gallery = command.run.gallery;
  io::Lock const lock(graph::lock_file(gallery), kFollows);
  if (!lock.held()) {
    fmt::print(stderr, "error: another run holds {}\n", printable(gallery.string()));
    return kBusy;
  }
  io::sweep_unfinished(gallery);
  remember_command(gallery);
  graph::Night night(gallery);
  night.forget(command.retry);
  graph::GuardReport const report = watch_over(night, command, lock);
  if (night.archive().entries.empty()) {
    refuse(command, report);
    return exit_code(night, report);
  }
  if (command.prune) prune(night, gallery);
  double const seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  graph::Summary const summary = graph::summarise(night, report, seconds, gallery);
  publish_reports(command, night, summary);
  publish_page(gallery, night.rows(), command.model.encode.x3dom);
  fmt::print("{}", summary_text(summary, gallery.string()));
  return exit_code(night, report);
}

/// What a run would do: nothing is written.
int rehearse(ConvertCommand const& command) {
  graph::Work work = work_of(command);
  work.known = graph::recorded(command.run.gallery);
  Rehearsal rehearsal;
  graph::WorkEvents events;
  events.archive = [&](io::Archive const& archive) { rehearsal.archive = archive; };
  events.stage = [](auto const&, auto const&) {};
  events.fresh = [&](graph::Record const& record) { rehearsal.fresh.push_back(record); };
  events.todo = [&](std::string const& slug, std::string const& why) { rehearsal.todo[slug] = why; };
  events.converting = [] {};
  graph::do_work(work, events);
  fmt::print("{}", rehearsal_text(rehearsal, work));
  return rehearsal.archive.entries.empty() ? kFatal : kComplete;
}

}  // namespace

int convert(ConvertCommand const& command) try {
  if (graph::is_worker()) return graph::run_worker(work_of(command));
  return command.dry_run ? rehearse(command) : run(command);
} catch (fs::filesystem_error const& error) {
  fmt::print(stderr, "error: {}\n", printable(error.what()));
  return io::is_full(error.code()) ? kDiskFull : kMachine;
}

}  // namespace vitrine::tools
