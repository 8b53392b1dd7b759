// SPDX-License-Identifier: Apache-2.0
#include "graph/trace.h"

#include <nlohmann/json.hpp>

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

namespace vitrine::graph {
namespace {

using json = nlohmann::ordered_json;

constexpr int kThreads = 1, kModels = 2;  // the groups of tracks

json slice(std::string_view name, int group, std::size_t track, std::int64_t begin, std::int64_t end) {
  return {{"name", name}, {"ph", "X"}, {"pid", group}, {"tid", track}, {"ts", begin}, {"dur", end - begin}};
}

json counter(std::string_view name, std::int64_t at, std::string_view unit, double value) {
  return {{"name", name}, {"ph", "C"}, {"pid", kThreads}, {"ts", at}, {"args", {{unit, value}}}};
}

json name(std::string_view what, int group, std::size_t track, std::string const& text) {
  return {{"name", what}, {"ph", "M"}, {"pid", group}, {"tid", track}, {"args", {{"name", text}}}};
}

}  // namespace

void Trace::stage(std::size_t model, std::string_view stage, int thread, Clock::time_point begin,
                  Clock::time_point end) {
  std::scoped_lock const lock(mutex_);
  spans_.push_back({model, stage, thread, since_start(begin), since_start(end)});
}

void Trace::model(std::size_t model, std::string const& name, Clock::time_point begin, Clock::time_point end) {
  std::scoped_lock const lock(mutex_);
  models_.push_back({model, name, since_start(begin), since_start(end)});
}

void Trace::memory(std::uint64_t admitted, std::size_t models) {
  std::scoped_lock const lock(mutex_);
  memory_.push_back({since_start(Clock::now()), admitted, memory_used(), models});
}

std::string Trace::json() const {
  std::scoped_lock const lock(mutex_);
  auto events = nlohmann::ordered_json::array();
  events.push_back(name("process_name", kThreads, 0, "threads"));
  events.push_back(name("process_name", kModels, 0, "models"));
  for (Model const& m : models_) {
    events.push_back(name("thread_name", kModels, m.number + 1, m.name));
    events.push_back(slice(m.name, kModels, m.number + 1, m.begin, m.end));
  }
  for (Span const& s : spans_) {
    events.push_back(slice(s.stage, kModels, s.model + 1, s.begin, s.end));
    events.push_back(slice(s.stage, kThreads, std::size_t(s.thread) + 1, s.begin, s.end));
    events.back()["args"] = {{"model", s.model}};
  }
  for (Memory const& m : memory_) {
    events.push_back(counter("memory admitted", m.at, "MB", double(m.admitted) / 1e6));
    events.push_back(counter("memory used", m.at, "MB", double(m.used) / 1e6));
    events.push_back(counter("models under way", m.at, "models", double(m.models)));
  }
  nlohmann::ordered_json const all = {{"displayTimeUnit", "ms"}, {"traceEvents", std::move(events)}};
  return all.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::uint64_t memory_used() {
  std::uint64_t all = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> all >> resident;
  return resident * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

std::uint64_t peak_memory() {
  rusage own{}, children{};
  ::getrusage(RUSAGE_SELF, &own);
  ::getrusage(RUSAGE_CHILDREN, &children);
  return static_cast<std::uint64_t>(std::max(own.ru_maxrss, children.ru_maxrss)) * 1024;
}

double cpu_seconds() {
  auto const seconds = [](timeval const& t) { return double(t.tv_sec) + double(t.tv_usec) / 1e6; };
  double sum = 0;
  for (auto const who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    ::getrusage(who, &usage);
    sum += seconds(usage.ru_utime) + seconds(usage.ru_stime);
  }
  return sum;
}

}  // namespace vitrine::graph
