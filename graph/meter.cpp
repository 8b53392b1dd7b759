// SPDX-License-Identifier: Apache-2.0
#include "graph/meter.h"

#include "graph/trace.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>

namespace vitrine::graph {
namespace {

constexpr std::chrono::milliseconds kPeriod{50};

double seconds(timeval const& t) { return double(t.tv_sec) + double(t.tv_usec) / 1e6; }

/// That threads which could run did not.
double seconds_without_core() {
  double sum = 0;
  std::error_code error;
  for (std::filesystem::directory_iterator it("/proc/self/task", error), end; !error && it != end;
       it.increment(error)) {
    double ran = 0, waited = 0;
    std::ifstream(it->path() / "schedstat") >> ran >> waited;
    sum += waited / 1e9;
  }
  return sum;
}

double cores(std::size_t threads) {
  unsigned const all = std::max(std::thread::hardware_concurrency(), 1u);
  return double(std::min<std::size_t>(threads, all));
}

}  // namespace

Moment this_moment() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  std::chrono::duration<double> const now = std::chrono::steady_clock::now().time_since_epoch();
  return {now.count(), seconds(usage.ru_utime) + seconds(usage.ru_stime), seconds_without_core(),
          std::uint64_t(usage.ru_inblock) * 512, memory_used()};
}

Meter::Meter(std::size_t threads, std::uint64_t allowed, std::uint64_t program)
    : tally_(cores(threads), allowed, program, this_moment()) {
  thread_ = std::jthread([this](std::stop_token stop) { run(stop); });
}

std::size_t Meter::begin(std::string_view stage) {
  std::scoped_lock const lock(mutex_);
  return tally_.begin(stage);
}

std::uint64_t Meter::end(std::size_t ticket) {
  std::uint64_t const memory = memory_used();
  std::scoped_lock const lock(mutex_);
  return tally_.end(ticket, memory);
}

void Meter::admission(Admission const& admission) {
  std::scoped_lock const lock(mutex_);
  tally_.admission(admission);
}

Occupancy Meter::take() {
  std::scoped_lock const lock(mutex_);
  tally_.pass(this_moment());
  return tally_.take();
}

void Meter::run(std::stop_token stop) {
  std::unique_lock lock(mutex_);
  while (!wake_.wait_for(lock, stop, kPeriod, [&] { return stop.stop_requested(); })) tally_.pass(this_moment());
}

}  // namespace vitrine::graph
