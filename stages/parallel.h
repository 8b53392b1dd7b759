// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Fine parallelism inside a stage: the only header of stages/ that includes TBB.
/// Runs in the caller's task arena and isolates: a thread that waits here takes up no task of another model.
/// Results never depend on the number of threads: ranges are cut by `grain` alone.

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace vitrine {

/// body() as it is, for libraries that run in parallel inside.
template <class Body>
void isolated(Body const& body) {
  tbb::this_task_arena::isolate(body);
}

/// body(begin, end) over [0, n) in blocks of `grain`; blocks may run at once and in any order.
template <class Body>
void parallel_blocks(std::size_t n, std::size_t grain, Body const& body) {
  if (n <= grain) {
    if (n > 0) body(std::size_t{0}, n);
    return;
  }
  std::size_t const blocks = (n + grain - 1) / grain;
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t b) { body(b * grain, std::min(n, (b + 1) * grain)); });
  });
}

/// body(i) for i in [0, n).
template <class Body>
void parallel_for(std::size_t n, std::size_t grain, Body const& body) {
  parallel_blocks(n, grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) body(i);
  });
}

/// Folds map(begin, end) of all blocks with join(total, part), from left to right: the same result at any thread count.
template <class T, class Map, class Join>
T parallel_reduce(std::size_t n, std::size_t grain, T total, Map const& map, Join const& join) {
  std::vector<T> parts((n + grain - 1) / grain, total);
  parallel_blocks(n, grain, [&](std::size_t begin, std::size_t end) { parts[begin / grain] = map(begin, end); });
  for (T const& part : parts) total = join(std::move(total), part);
  return total;
}

}  // namespace vitrine
