// SPDX-License-Identifier: Apache-2.0
#include "graph/limits.h"

namespace vitrine::graph {
namespace {

constexpr std::chrono::seconds kSilence{600};
constexpr std::uint64_t kGrace = 256u << 20;  ///< bytes

}  // namespace

double stall_limit(io::ArchiveEntry const& entry) { return 300 + double(entry.estimate.triangles) / 5000; }

std::optional<Sentence> Limits::hangs(
    Flight const& in_flight, std::chrono::steady_clock::time_point now,
    std::function<io::ArchiveEntry const*(std::string const& slug)> const& entry) const {
  for (auto const& [slug, step] : in_flight) {
    io::ArchiveEntry const* const known = entry(slug);
    double const limit = stall > 0 ? stall : known ? stall_limit(*known) : stall_limit({});
    if (std::chrono::duration<double>(now - step.since).count() <= limit) continue;
    return Sentence{"no progress in " + std::to_string(int(limit)) + " s",
                    "raise --stall-limit if this machine is that slow, or please report this model as a bug"};
  }
  return std::nullopt;
}

std::optional<Sentence> Limits::swells(std::uint64_t used) const {
  if (used <= memory + memory / 4 + kGrace) return std::nullopt;
  return Sentence{"used up the memory: " + std::to_string(used / 1'000'000) + " MB, and --memory allows " +
                      std::to_string(memory / 1'000'000),
                  "run again with more --memory"};
}

std::optional<Sentence> silent(std::chrono::steady_clock::duration since) {
  return since > kSilence ? std::optional(Sentence{"the worker is silent", ""}) : std::nullopt;
}

}  // namespace vitrine::graph
