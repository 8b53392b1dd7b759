// SPDX-License-Identifier: Apache-2.0
#include "graph/occupancy.h"

#include <algorithm>
#include <array>
#include <utility>

namespace vitrine::graph {

Occupancy& Occupancy::operator+=(Occupancy const& later) {
  for (auto const sum :
       {&Occupancy::seconds, &Occupancy::available, &Occupancy::computed, &Occupancy::taken, &Occupancy::memory,
        &Occupancy::reading, &Occupancy::writing, &Occupancy::ending, &Occupancy::within})
    this->*sum += later.*sum;
  disk_bytes += later.disk_bytes;
  if (later.peak > peak) peak = later.peak, admitted = later.admitted;
  most_admitted = std::max(most_admitted, later.most_admitted);
  allowed = std::max(allowed, later.allowed);
  return *this;
}

Bound bound(Occupancy const& o) {
  if (o.available <= 0) return Bound::nothing;
  std::array<std::pair<double, Bound>, 5> const idle{{{o.memory, Bound::memory},
                                                      {o.reading, Bound::reading},
                                                      {o.writing, Bound::writing},
                                                      {o.ending, Bound::ending},
                                                      {o.within, Bound::within}}};
  double all = 0;
  for (auto const& [seconds, why] : idle) all += seconds;
  if (all < 0.1 * o.available) return Bound::cores;
  return std::max_element(idle.begin(), idle.end(), [](auto const& a, auto const& b) { return a.first < b.first; })
      ->second;
}

std::string_view shown(Bound bound) {
  constexpr std::array<std::string_view, 7> names{"nothing", "cores",  "memory", "reading",
                                                  "writing", "ending", "within"};
  return names[std::size_t(bound)];
}

std::size_t Tally::begin(std::string_view stage) {
  running_[++tickets_] = {stage, 0};
  return tickets_;
}

std::uint64_t Tally::end(std::size_t ticket, std::uint64_t memory) {
  auto const found = running_.extract(ticket);
  return std::max(found.mapped().peak, memory);
}

void Tally::admission(Admission const& admission) {
  admitted_ = program_ + admission.memory_in_use();
  waits_ = admission.models_waiting() > 0;
  waits_for_memory_ = admission.waits_for_memory();
  sums_.most_admitted = std::max(sums_.most_admitted, admitted_);
}

bool Tally::runs(std::string_view stage) const {
  return std::any_of(running_.begin(), running_.end(), [&](auto const& each) { return each.second.stage == stage; });
}

double& Tally::reason(bool from_disk) {
  if (waits_for_memory_) return sums_.memory;
  if (from_disk && runs("load")) return sums_.reading;
  if (runs("publish")) return sums_.writing;
  return waits_ ? sums_.within : sums_.ending;
}

void Tally::pass(Moment const& now) {
  double const seconds = now.seconds - last_.seconds, available = cores_ * seconds;
  double const computed = std::min(now.computed - last_.computed, available);
  double const taken = std::clamp(now.taken - last_.taken, 0.0, available - computed);
  sums_.seconds += seconds;
  sums_.available += available;
  sums_.computed += computed;
  sums_.taken += taken;
  reason(now.disk_bytes > last_.disk_bytes) += available - computed - taken;
  sums_.disk_bytes += now.disk_bytes - last_.disk_bytes;
  sums_.allowed = allowed_;
  if (now.memory > sums_.peak) sums_.peak = now.memory, sums_.admitted = admitted_;
  for (auto& [ticket, running] : running_) running.peak = std::max(running.peak, now.memory);
  last_ = now;
}

Occupancy Tally::take() { return std::exchange(sums_, {}); }

}  // namespace vitrine::graph
