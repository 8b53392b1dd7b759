// SPDX-License-Identifier: Apache-2.0
#include "tools/night.h"

#include "graph/chronicle.h"
#include "graph/freshness.h"
#include "graph/night.h"
#include "io/lock.h"
#include "stages/error.h"
#include "tools/command_memory.h"
#include "tools/printable.h"

#include <fmt/format.h>

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <set>
#include <system_error>

namespace vitrine::tools {
namespace {

namespace fs = std::filesystem;
using graph::Record;

constexpr int kFine = 0, kUsage = 2, kDamage = 4;

/// What the ledger holds, and the certificates of models that it does not know.
std::map<std::string, Record> everything(fs::path const& gallery) {
  std::map<std::string, Record> records = graph::recorded(gallery);
  std::error_code error;
  for (fs::directory_iterator it(gallery / "models", error), end; !error && it != end; it.increment(error)) {
    std::string const slug = it->path().filename();
    if (records.contains(slug)) continue;
    if (std::optional<Record> record = graph::record_of_certificate(gallery, slug))
      records.emplace(slug, std::move(*record));
  }
  return records;
}

void print_problem(Record const& record) {
  graph::Failure const& failure = record.row.failure;
  fmt::print("{}: {}: {}: {}\n", printable(record.row.input), record.row.status, printable(failure.stage),
             printable(failure.reason));
}

/// A line of status.json, "" where it cannot be read.
std::string run_line(fs::path const& gallery, bool running) {
  std::ifstream file(gallery / ".vitrine/status.json");
  graph::StrictJson const status = graph::StrictJson::parse(file, nullptr, false);
  if (!status.is_object()) return "";
  std::string const state = status.value("state", ""), started = status.value("started", ""),
                    updated = status.value("updated", "");
  if (!running && state == "running")
    return fmt::format("died: run the same command again; started {}, last heard of {}\n", started, updated);
  std::string text =
      fmt::format("{}; started {}, updated {}; {} of {} models through, {} of them in this run, {} problems\n",
                  running ? "running" : state, started, updated, status.value("settled", 0), status.value("models", 0),
                  status.value("converted", 0), status.value("failed", 0));
  if (running)
    for (auto const& model : status.value("underWay", graph::StrictJson::array()))
      text += fmt::format("  {}: {}\n", model.value("model", ""), model.value("stage", ""));
  return text;
}

std::string dependency_lines(Record const& record) {
  std::string text;
  for (auto const& [name, hash] : record.row.dependencies)
    text += "  names " + name + (hash.empty() ? ", which is missing\n" : "\n");
  return text;
}

}  // namespace

int status(fs::path const& gallery) {
  bool const running = fs::exists(graph::lock_file(gallery)) && !io::Lock(graph::lock_file(gallery)).held();
  fmt::print("{}", printable_lines(run_line(gallery, running)));
  std::map<std::string, std::size_t> counts;
  std::map<std::string, Record> const records = everything(gallery);
  for (auto const& [slug, record] : records) ++counts[record.row.status];
  for (auto const& [name, count] : counts) fmt::print("{} {}\n", count, name);
  for (auto const& [slug, record] : records)
    if (record.row.status != "done") print_problem(record);
  return kFine;
}

int why(fs::path const& gallery, std::string const& model) {
  std::map<std::string, Record> const records = everything(gallery);
  std::vector<Record const*> found;
  for (auto const& [slug, record] : records) {
    if (record.row.input == model || slug == model) {
      found = {&record};
      break;
    }
    if (record.row.input.find(model) != std::string::npos) found.push_back(&record);
  }
  if (found.size() != 1) {
    fmt::print(stderr, "error: {} models of this gallery have \"{}\" in their path\n", found.size(), printable(model));
    for (std::size_t i = 0; i < std::min<std::size_t>(found.size(), 10); ++i)
      fmt::print(stderr, "  {}\n", printable(found[i]->row.input));
    return kUsage;
  }
  Record const& record = *found.front();
  std::string text = record.row.input + ": " + record.row.status + "\n";
  if (record.row.status != "done") {
    graph::Failure const& failure = record.row.failure;
    text += "  " + failure.stage + ": " + failure.reason + "\n  " + failure.remedy + "\n";
    if (record.since > 0) text += "  first seen by the run of " + graph::utc(record.since) + "\n";
    if (failure.cause != graph::Cause::model) text += "  the next run tries it again: this lay in the machine\n";
    if (!record.evidence.empty()) text += "  the last lines of its log:\n" + record.evidence;
  } else {
    std::vector<std::string> const bad = graph::damage(record.row, gallery, true);
    for (std::string const& line : bad) text += "  " + line + ": the next run with --verify makes it anew\n";
    if (bad.empty()) text += "  as published; vitrine convert --dry-run tells whether its original has changed\n";
  }
  fmt::print("{}", printable_lines(text + dependency_lines(record)));
  return kFine;
}

int retry(fs::path const& gallery, bool quarantined) {
  Remembered const command = remembered_command(gallery);
  std::vector<std::string> arguments = command.arguments;
  auto const verb = std::find(arguments.begin(), arguments.end(), "convert");
  if (verb == arguments.end())
    throw Error(ErrorKind::invalid_input, "the remembered command is none of convert",
                "run vitrine convert, as at first");
  std::string const what = quarantined ? "quarantined" : "failed";
  arguments.insert(verb + 1, {"--retry", what});
  fs::current_path(command.folder);
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  ::execv("/proc/self/exe", pointers.data());
  throw std::system_error(errno, std::generic_category(), "cannot run the command again");
}

int check(fs::path const& gallery) {
  std::size_t files = 0, damaged = 0;
  std::set<std::string> vouched;
  for (auto const& [slug, record] : everything(gallery)) {
    vouched.insert(slug);
    if (record.row.status != "done") continue;
    files += record.row.files.size();
    for (std::string const& line : graph::damage(record.row, gallery, true)) {
      ++damaged;
      fmt::print("{}\n", printable(line));
    }
  }
  std::error_code error;
  for (fs::directory_iterator it(gallery / "models", error), end; !error && it != end; it.increment(error))
    if (!vouched.contains(it->path().filename())) {
      ++damaged;
      fmt::print("models/{} has no valid certificate\n", printable(it->path().filename()));
    }
  fmt::print("{} files checked, {} damaged or missing\n", files, damaged);
  if (damaged > 0) fmt::print("vitrine convert --verify makes them anew\n");
  return damaged > 0 ? kDamage : kFine;
}

}  // namespace vitrine::tools
