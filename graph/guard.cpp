// SPDX-License-Identifier: Apache-2.0
#include "graph/guard.h"

#include "graph/admission.h"
#include "graph/child.h"
#include "graph/death.h"
#include "graph/events.h"
#include "graph/limits.h"
#include "graph/listen.h"
#include "graph/signals.h"
#include "graph/suspects.h"
#include "graph/wire.h"
#include "graph/worker.h"
#include "io/fault.h"
#include "io/publish.h"

#include <unistd.h>

#include <csignal>

namespace vitrine::graph {
namespace {

using json = StrictJson;
namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kWatch{100};  ///< between two looks at disk, clock and memory
constexpr std::chrono::seconds kDying{2};         ///< a process may take from closing its files to being gone
constexpr int kBarrenDeaths = 3;                  ///< workers that die before they open a model
constexpr int kUnwritable = 5;                    ///< models that could not be published, until it must be the gallery
constexpr std::uintmax_t kDiskReserve = 16'000'000;  ///< bytes; below them no model is begun

Sentence const kNonsense{"the worker spoke nonsense", "please report this model as a bug"};
Sentence const kHungUp{"it closed the worker's line to the guard", "please report this model as a bug"};

class Guard {
 public:
  Guard(Night& night, GuardOptions const& options, GuardListener const& listener)
      : night_(night),
        options_(options),
        listener_(listener),
        limits_{options.memory ? options.memory : default_memory(), options.stall_limit} {
    hear();
  }

  GuardReport run() {
    while (!ended_ && (!suspects_.all().empty() || !passed_)) round();
    return report_;
  }

 private:
  // ---- What the worker says

  void hear() {
    events_.archive = [this](io::Archive const& archive) {
      in_flight_.clear();
      if (night_.archive().entries.empty())
        for (std::string const& note : archive.notes) listener_.say("note: " + note);
      night_.found(archive);
      for (auto const& [slug, found] : convicts_)  // before the archive was known
        if (!night_.settled(slug)) enter(slug, found);
    };
    events_.stage = [this](std::string const& slug, std::string const& stage) {
      if (stage == "estimate")
        in_flight_.clear();  // one after the other
      else if (!known(slug))
        return;
      in_flight_[slug] = {stage, Clock::now()};
    };
    events_.fresh = [this](Record const& record) {
      if (!known(record.row.slug)) return;
      in_flight_.erase(record.row.slug);
      suspects_.clear(record.row.slug);
      keep([&] { night_.fresh(record); });
    };
    events_.todo = [this](std::string const& slug, std::string const& why) {
      if (!known(slug)) return;
      in_flight_.erase(slug);
      if (!alone_) night_.todo(slug, why);
    };
    events_.converting = [this] {
      if (!alone_ && !announced_) listener_.converting();
      announced_ = true;
    };
    events_.occupied = [this](Occupancy const& occupancy) { report_.occupancy += occupancy; };
    events_.finished = [this](Record const& record) {
      if (known(record.row.slug)) finished(record);
    };
  }

  bool known(std::string const& slug) {
    bool const is = night_.entry(slug);
    if (!is) condemn(kNonsense);
    return is;
  }

  void message(json const& said) try {
    silent_since_ = Clock::now();
    listener_.event(said);
    std::string const event = said.at("event");
    if (event == "end") {
      through_ = true;
    } else if (event == "error") {
      end(said.value("machine", false) ? Ending::machine : Ending::refused,
          said.value("what", "") + "; " + said.value("remedy", ""));
    } else if (event == "confined") {
      report_.confinement = said.value("level", "");
      report_.missing = said.value("missing", "");
      if (report_.workers == 1 && !report_.missing.empty())
        listener_.say("warning: models are opened without the protection of " + report_.missing);
    } else if (!deliver(said, events_)) {
      condemn(kNonsense);
    }
  } catch (json::exception const&) {
    condemn(kNonsense);
  }

  void finished(Record const& record) {
    Failure const& failure = record.row.failure;
    in_flight_.erase(record.row.slug);
    if (record.row.status != "done" && failure.cause == Cause::stopped) return;
    if (record.row.status != "done" && failure.cause == Cause::disk) return stop(Ending::disk, failure.reason);
    if (record.row.status != "done" && failure.cause == Cause::memory && failure.stage != "admit" && !alone_)
      return suspects_.suspect(record.row.slug);  // others may have taken it
    if (failure.cause == Cause::machine && failure.stage == "publish" && ++unwritable_ >= kUnwritable)
      stop(Ending::machine, failure.reason);
    settle(record);
  }

  void settle(Record const& record) {
    suspects_.clear(record.row.slug);
    keep([&] { night_.finished(record); });
    listener_.left(record);
  }

  /// A ledger that cannot be written ends the night; it is no model's fault.
  template <class Entry>
  void keep(Entry const& entry) {
    try {
      entry();
    } catch (fs::filesystem_error const& error) {
      stop(io::is_full(error.code()) ? Ending::disk : Ending::machine, error.what());
    }
  }

  // ---- One worker's life

  void round() {
    alone_ = !suspects_.all().empty();
    through_ = false;
    condemned_.reset();
    in_flight_.clear();
    lines_ = {};
    silent_since_ = Clock::now();
    ++report_.workers;
    Child child(options_.arguments, options_.lock);
    child_ = &child;
    io::fault("guard:spawned");
    send(child.orders(), to_json(order()));
    if (stopping_) send(child.orders(), {{"order", "stop"}});
    int const status = listen(child, signals_.descriptor(), lines_, ears(child));
    child_ = nullptr;
    io::fault("guard:buried");
    if (!through_ && !ended_) return autopsy(status);
    if (stopping_) ended_ = true;
    if (alone_)
      for (std::string const& slug : std::set<std::string>(suspects_.all()))
        suspects_.clear(slug);  // gone from the archive
    else
      passed_ = true;
  }

  Order order() const {
    Order order{night_.known(), night_.settled(), {}, {}, limits_.memory, alone_};
    for (auto const& [slug, found] : convicts_) order.unopened.insert(slug);
    if (alone_) order.only = suspects_.all();
    return order;
  }

  Ears ears(Child& child) {
    return {[this](json const& said) { message(said); },
            [this](std::string const& line) {
              listener_.event({{"event", "log"}, {"line", line}});
            },
            [this] { signalled(); },
            [this, &child](Clock::duration deaf) {
              if (deaf > kDying && !through_) condemn(kHungUp);
              watch(child);
              listener_.tick();
            }};
  }

  /// What the guard looks at between messages.
  void watch(Child& child) {
    Clock::time_point const now = Clock::now();
    if (now - watched_ < kWatch) return;
    watched_ = now;
    if (options_.stop_at && std::chrono::system_clock::now() >= *options_.stop_at)
      stop(Ending::interrupted, "it is the time given by --stop-at");
    std::error_code error;
    if (fs::space_info const space = fs::space(options_.gallery, error); !error && space.available < kDiskReserve)
      stop(Ending::disk, "less than 16 MB are left on the gallery's disk");
    if (condemned_) return;
    std::optional<Sentence> sentence =
        limits_.hangs(in_flight_, now, [this](std::string const& slug) { return night_.entry(slug); });
    if (!sentence && in_flight_.empty() && !through_) sentence = silent(now - silent_since_);
    if (!sentence) sentence = limits_.swells(child.memory());
    if (sentence) condemn(*sentence);
  }

  void condemn(Sentence const& sentence) {
    if (condemned_ || !child_) return;
    condemned_ = sentence;
    child_->kill();
  }

  // ---- Ends

  void signalled() {
    int const signal = signals_.take();
    if (signal == 0 || signal == SIGCHLD) return;
    if (stopping_) {
      ended_ = true;
      if (child_) child_->kill();
      return;
    }
    stop(Ending::interrupted, std::string("stopped by SIG") + sigabbrev_np(signal), "; once more to stop at once");
  }

  /// What is under way is finished, nothing else begun.
  void stop(Ending ending, std::string const& reason, std::string const& advice = {}) {
    if (stopping_) return;
    listener_.say(reason + ": finishing " + std::to_string(in_flight_.size()) + " models that are under way" + advice);
    stopping_ = true;
    report_.ending = ending;
    report_.reason = reason;
    if (child_) send(child_->orders(), {{"order", "stop"}});
  }

  void end(Ending ending, std::string const& reason) {
    if (!stopping_) report_.ending = ending, report_.reason = reason;
    stopping_ = ended_ = true;
  }

  /// A worker died before it was through.
  void autopsy(int status) {
    std::set<std::string> victims;
    for (auto const& [slug, step] : in_flight_) victims.insert(slug);
    Death const death{status, condemned_};
    listener_.event({{"event", "died"}, {"how", death.how()}, {"inFlight", victims}});
    if (stopping_) return void(ended_ = true);
    if (victims.empty()) {
      if (++barren_ >= kBarrenDeaths) end(Ending::machine, "the worker dies before it opens a model: " + death.how());
      return;
    }
    if (std::optional<std::string> const culprit = suspects_.died(victims, death.by_a_stranger())) {
      Conviction const& found = convicts_[*culprit] = convict(death, in_flight_[*culprit].stage, lines_.text());
      return enter(*culprit, found);
    }
    listener_.say("the worker died (" + death.how() + ") with " + std::to_string(victims.size()) +
                  " models under way; trying them one at a time");
  }

  void enter(std::string const& slug, Conviction const& found) {
    if (io::ArchiveEntry const* const entry = night_.entry(slug)) settle(record_of(found, *entry, options_.model));
  }

  Night& night_;
  GuardOptions const& options_;
  GuardListener const& listener_;
  Limits limits_;
  WorkEvents events_;
  Signals signals_;
  GuardReport report_;
  Child* child_ = nullptr;
  Flight in_flight_;
  LastLines lines_;
  Clock::time_point silent_since_, watched_;
  std::optional<Sentence> condemned_;
  Suspects suspects_;
  std::map<std::string, Conviction> convicts_;
  int barren_ = 0, unwritable_ = 0;
  bool alone_ = false, announced_ = false, through_ = false, passed_ = false, stopping_ = false, ended_ = false;
};

}  // namespace

GuardReport guard(Night& night, GuardOptions const& options, GuardListener const& listener) {
  return Guard(night, options, listener).run();
}

}  // namespace vitrine::graph
