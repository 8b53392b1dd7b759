// SPDX-License-Identifier: Apache-2.0
#include "graph/work.h"

#include "graph/arrival.h"
#include "graph/pipeline.h"
#include "graph/settings.h"
#include "stages/parallel.h"

#include <chrono>
#include <mutex>
#include <optional>
#include <vector>

namespace vitrine::graph {
namespace {

using Clock = std::chrono::system_clock;

class Pass {
 public:
  Pass(Work const& work, WorkEvents const& events) : work_(work), events_(events) {}

  void run() {
    io::Archive const archive = io::read_archive(work_.archive, work_.reading, [&](io::ArchiveEntry const& entry) {
      say([&] { events_.stage(entry.slug, "estimate"); });
      return !work_.unopened.contains(entry.slug);
    });
    events_.archive(archive);
    io::Archive const todo = look(archive);
    events_.converting();
    if (!work_.dry) convert(todo);
  }

 private:
  template <class Event>
  void say(Event const& event) {
    std::scoped_lock const lock(mutex_);
    event();
  }

  /// The entries that are to be converted.
  io::Archive look(io::Archive const& archive) {
    std::vector<char> wanted(archive.entries.size());
    parallel_for(archive.entries.size(), 1, [&](std::size_t i) {
      io::ArchiveEntry const& entry = archive.entries[i];
      if (work_.settled.contains(entry.slug) || work_.unopened.contains(entry.slug)) return;
      if (work_.run.stop.stop_requested() || !(work_.only.empty() || work_.only.contains(entry.slug))) return;
      say([&] { events_.stage(entry.slug, "compare"); });
      auto const known = work_.known.find(entry.slug);
      Freshness const found = freshness(entry, known == work_.known.end() ? std::nullopt : std::optional(known->second),
                                        work_.model, work_.run.gallery, work_.freshness);
      wanted[i] = !found.fresh;
      say([&] { found.fresh ? events_.fresh(found.record) : events_.todo(entry.slug, found.why); });
    });
    io::Archive todo;
    for (std::size_t i = 0; i < wanted.size(); ++i)
      if (wanted[i]) todo.entries.push_back(archive.entries[i]);
    return todo;
  }

  void convert(io::Archive const& todo) {
    std::map<std::string, Clock::time_point> begun;  // before a model's first byte is read
    RunOptions run = work_.run;
    run.stage = [&](io::ArchiveEntry const& entry, std::string_view stage) {
      say([&] {
        begun.try_emplace(entry.slug, Clock::now());
        events_.stage(entry.slug, std::string(stage));
      });
    };
    run.occupied = [&](Occupancy const& occupancy) { say([&] { events_.occupied(occupancy); }); };
    run_pipeline(todo, work_.model, run, [&](ModelRow const& row, std::size_t number) {
      io::ArchiveEntry const& entry = todo.entries[number];
      say([&] {
        Record record{row, settings_hash(work_.model, row.title, entry.up), {}, 0, {}};
        if (auto const since = begun.extract(entry.slug))
          record.stamps = stamps_since(since.mapped(), entry, row.dependencies);
        events_.finished(record);
      });
    });
  }

  Work const& work_;
  WorkEvents const& events_;
  std::mutex mutex_;
};

}  // namespace

void do_work(Work const& work, WorkEvents const& events) { Pass(work, events).run(); }

double cost(io::ArchiveEntry const& entry) { return 3e5 + double(entry.estimate.triangles); }

}  // namespace vitrine::graph
