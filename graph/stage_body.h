// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The one adapter around every body in the graph: passes failures on, turns exceptions into failures, keeps the time.
/// An exception that left a node's body would cancel the whole graph.

#include "graph/message.h"
#include "stages/error.h"

#include <chrono>
#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <string_view>

namespace vitrine::graph {

/// What the exception in flight says, as a failure of this stage. Call inside a catch block.
inline Failure current_failure(std::string_view stage) {
  try {
    throw;
  } catch (Error const& e) {
    return {std::string(stage), e.what(), e.remedy()};
  } catch (std::bad_alloc const&) {
    return {std::string(stage), "out of memory",
            "convert it alone, or lower --memory so that fewer models share the machine"};
  } catch (std::filesystem::filesystem_error const& e) {
    return {std::string(stage), e.what(), "check the gallery's disk space and permissions"};
  } catch (std::exception const& e) {
    return {std::string(stage), std::string("unexpected: ") + e.what(), "please report this model as a bug"};
  } catch (...) {
    return {std::string(stage), "unexpected: an exception of unknown type", "please report this model as a bug"};
  }
}

/// A stage that a search repeats has one sum.
inline void add_seconds(ModelRow& row, std::string_view stage, double seconds) {
  for (auto& [name, sum] : row.seconds)
    if (name == stage) {
      sum += seconds;
      return;
    }
  row.seconds.emplace_back(stage, seconds);
}

/// body(std::shared_ptr<In const> const&, Job&) -> Out, as the body of a node from Message<In> to Message<Out>.
template <class In, class Out, class Body>
auto stage(std::string_view name, Body body) {
  return [name, body](Message<In> const& in) -> Message<Out> {
    if (auto const* failure = std::get_if<Failure>(&in.value)) return {in.job, *failure};
    auto const start = std::chrono::steady_clock::now();
    Message<Out> out{in.job, Failure{}};
    try {
      out.value = std::make_shared<Out const>(body(std::get<std::shared_ptr<In const>>(in.value), *in.job));
    } catch (...) {
      out.value = current_failure(name);
    }
    std::chrono::duration<double> const spent = std::chrono::steady_clock::now() - start;
    add_seconds(in.job->row, name, spent.count());
    return out;
  };
}

}  // namespace vitrine::graph
