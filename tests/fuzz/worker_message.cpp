// SPDX-License-Identifier: Apache-2.0
// What a worker that a model has taken over says to the guard; the same bytes stand in the ledger.
#include "graph/events.h"
#include "graph/wire.h"
#include "tests/fuzz/reader.h"

#include <unistd.h>

namespace {

using namespace vitrine;

void hear(graph::Record const& record) {
  fuzz::require(!graph::describe(record.row).empty());
  fuzz::require(!graph::to_text(graph::report_json({record.row}, "archive", {}, 0)).empty());
  fuzz::require(!graph::report_csv({record.row}).empty());
  fuzz::require(graph::record_from(graph::to_bytes(record)).has_value());
}

graph::WorkEvents hearing() {
  graph::WorkEvents events;
  events.archive = [](io::Archive const&) {};
  events.stage = [](std::string const&, std::string const&) {};
  events.fresh = hear;
  events.todo = [](std::string const&, std::string const&) {};
  events.converting = [] {};
  events.occupied = [](graph::Occupancy const&) {};
  events.finished = hear;
  return events;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  constexpr std::size_t kPipe = 1 << 16;
  std::uint32_t const length = std::uint32_t(size);
  if (size + sizeof length > kPipe) return 0;
  static int const* const pipe = [] {
    static int ends[2];
    fuzz::require(::pipe(ends) == 0);
    return ends;
  }();
  fuzz::require(::write(pipe[1], &length, sizeof length) == sizeof length);
  fuzz::require(::write(pipe[1], data, size) == ssize_t(size));
  static graph::WorkEvents const events = hearing();
  graph::Inbox(pipe[0]).read([](graph::StrictJson const& message) { graph::deliver(message, events); });
  return 0;
}
