// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The one adapter around every body in the graph: passes failures on, turns exceptions into failures, keeps the time.
/// An exception that left a node's body would cancel the whole graph.

#include "graph/message.h"
#include "io/fault.h"
#include "io/publish.h"
#include "stages/error.h"

#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace vitrine::graph {

/// A full disk is never the model's fault, nor is a disk that fails or a gallery that cannot be written.
inline Cause cause_of(std::filesystem::filesystem_error const& error, std::string_view stage) {
  if (io::is_full(error.code())) return Cause::disk;
  bool const failing = error.code() == std::errc::io_error || error.code().value() == ESTALE;
  return failing || stage == "publish" ? Cause::machine : Cause::model;
}

/// What the exception in flight says, as a failure of this stage. Call inside a catch block.
inline Failure current_failure(std::string_view stage) {
  try {
    throw;
  } catch (Error const& e) {
    return {std::string(stage), e.what(), e.remedy()};
  } catch (std::bad_alloc const&) {
    return {std::string(stage), "out of memory",
            "convert it alone, or lower --memory so that fewer models share the machine", Cause::memory};
  } catch (std::filesystem::filesystem_error const& e) {
    return {std::string(stage), e.what(), "check the gallery's disk space and permissions", cause_of(e, stage)};
  } catch (std::exception const& e) {
    return {std::string(stage), std::string("unexpected: ") + e.what(), "please report this model as a bug"};
  } catch (...) {
    return {std::string(stage), "unexpected: an exception of unknown type", "please report this model as a bug"};
  }
}

/// A stage that a search repeats has one figure.
template <class Value>
Value& of_stage(std::vector<std::pair<std::string, Value>>& figures, std::string_view stage) {
  for (auto& [name, value] : figures)
    if (name == stage) return value;
  return figures.emplace_back(stage, Value{}).second;
}

inline double seconds_of(Trace::Clock::duration spent) { return std::chrono::duration<double>(spent).count(); }

/// The one place where stages meet a clock. `ticket`: of the meter.
inline void note_stage(Job& job, std::string_view stage, Trace::Clock::time_point begin, std::size_t ticket) {
  auto const end = Trace::Clock::now();
  of_stage(job.row.seconds, stage) += seconds_of(end - begin);
  of_stage(job.row.waiting, stage) += seconds_of(begin - job.ready);
  std::uint64_t& peak = of_stage(job.row.peaks, stage);
  peak = std::max(peak, job.meter->end(ticket));
  job.ready = end;
  if (job.trace)
    job.trace->stage(job.number, stage, std::max(0, tbb::this_task_arena::current_thread_index()), begin, end);
}

/// body(std::shared_ptr<In const> const&, Job&) -> Out, as the body of a node from Message<In> to Message<Out>.
template <class In, class Out, class Body>
auto stage(std::string_view name, Body body) {
  return [name, body](Message<In> const& in) -> Message<Out> {
    if (auto const* failure = std::get_if<Failure>(&in.value)) return {in.job, *failure};
    auto const begin = Trace::Clock::now();
    std::size_t const ticket = in.job->meter->begin(name);
    Message<Out> out{in.job, Failure{}};
    try {
      if (in.job->run->stage) in.job->run->stage(*in.job->entry, name);
      io::fault(name, in.job->entry->path);
      out.value = std::make_shared<Out const>(body(std::get<std::shared_ptr<In const>>(in.value), *in.job));
    } catch (...) {
      out.value = current_failure(name);
    }
    note_stage(*in.job, name, begin, ticket);
    return out;
  };
}

}  // namespace vitrine::graph
