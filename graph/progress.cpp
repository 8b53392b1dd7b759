// SPDX-License-Identifier: Apache-2.0
#include "graph/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

namespace vitrine::graph {
namespace {

constexpr int kBarWidth = 30;
constexpr char kClearLine[] = "\r\x1b[K";

std::string hours(double seconds) {
  auto const s = static_cast<long>(seconds + 0.5);
  return fmt::format("{:02}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

}  // namespace

std::string progress_line(ProgressState const& state, int width) {
  double const share = state.cost > 0 ? std::min(1.0, state.cost_done / state.cost) : 1;
  std::string line;
  if (width > 0) {
    auto const full = static_cast<std::size_t>(share * width);
    line = "[" + std::string(full, '#') + std::string(std::size_t(width) - full, '-') + "] ";
  }
  line += fmt::format("{}/{} models", state.done, state.models);
  if (state.failed > 0) line += fmt::format("  {} failed", state.failed);
  if (state.done > 0 && state.seconds > 0) {
    line += fmt::format("  {:.1f}/min", 60 * double(state.done) / state.seconds);
    if (state.done < state.models && share > 0) line += "  ETA " + hours(state.seconds * (1 - share) / share);
  }
  return line;
}

Progress::Progress(std::size_t models, double cost, bool live) : live_(live) {
  state_.models = models;
  state_.cost = cost;
  thread_ = std::jthread([this](std::stop_token stop) { run(stop); });
}

Progress::~Progress() {
  thread_.request_stop();
  thread_.join();
  if (live_) std::fputs(kClearLine, stderr);
}

void Progress::finished(double cost, bool failed) {
  std::scoped_lock const lock(mutex_);
  ++state_.done;
  state_.failed += failed;
  state_.cost_done += cost;
}

void Progress::say(std::string const& line) {
  std::scoped_lock const lock(mutex_);
  fmt::print(stderr, "{}{}\n", live_ ? kClearLine : "", line);
}

void Progress::run(std::stop_token stop) {
  auto const period = live_ ? std::chrono::milliseconds(500) : std::chrono::milliseconds(60'000);
  std::unique_lock lock(mutex_);
  while (!wake_.wait_for(lock, stop, period, [&] { return stop.stop_requested(); })) draw();
}

void Progress::draw() {
  std::chrono::duration<double> const elapsed = std::chrono::steady_clock::now() - start_;
  state_.seconds = elapsed.count();
  if (live_)
    fmt::print(stderr, "{}{}", kClearLine, progress_line(state_, kBarWidth));
  else
    fmt::print(stderr, "{}\n", progress_line(state_, 0));
  std::fflush(stderr);
}

}  // namespace vitrine::graph
