// SPDX-License-Identifier: Apache-2.0
#include "graph/admission.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace vitrine::graph {
namespace {

constexpr std::uint64_t kUnlimited = std::numeric_limits<std::uint64_t>::max();

std::uint64_t machine_available() {
  std::ifstream file("/proc/meminfo");
  std::string key, unit;
  for (std::uint64_t kib; file >> key >> kib; std::getline(file, unit))
    if (key == "MemAvailable:") return kib * 1024;
  return 4ull << 30;
}

std::uint64_t number_in(char const* path) {
  std::uint64_t value = kUnlimited;
  std::ifstream(path) >> value;
  return value ? value : kUnlimited;
}

/// What the control group (version 2, or 1) leaves.
std::uint64_t group_available() {
  std::uint64_t const limit =
      std::min(number_in("/sys/fs/cgroup/memory.max"), number_in("/sys/fs/cgroup/memory/memory.limit_in_bytes"));
  std::uint64_t const used =
      std::min(number_in("/sys/fs/cgroup/memory.current"), number_in("/sys/fs/cgroup/memory/memory.usage_in_bytes"));
  if (limit == kUnlimited || used == kUnlimited) return kUnlimited;
  return limit > used ? limit - used : 0;
}

}  // namespace

void Admission::release(std::uint64_t bytes) {
  used_ -= bytes;
  --running_;
}

std::vector<std::size_t> Admission::admit() {
  std::vector<std::size_t> admitted;
  for (auto it = waiting_.begin(); it != waiting_.end() && running_ < models_;) {
    if (used_ + it->bytes <= memory_) {
      used_ += it->bytes;
      ++running_;
      admitted.push_back(it->id);
      for (auto passed = waiting_.begin(); passed != it; ++passed) ++passed->passed;
      it = waiting_.erase(it);
    } else if (it->passed >= kPatience) {
      break;
    } else {
      ++it;
    }
  }
  return admitted;
}

std::uint64_t default_memory() { return std::min(machine_available(), group_available()) / 5 * 4; }

}  // namespace vitrine::graph
