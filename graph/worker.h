// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The process in which models are opened: takes one order from the guard, and tells it of every step. It may die at
/// any time.

#include "graph/strict_json.h"
#include "graph/work.h"

#include <set>
#include <string>

namespace vitrine::graph {

/// Whether this process was started as a worker.
bool is_worker();

/// What the guard asks for; the rest of the Work is in the command line that both share.
struct Order {
  std::map<std::string, Record> known;
  std::set<std::string> settled, unopened, only;
  std::uint64_t memory = 0;  ///< bytes for models
  bool alone = false;        ///< one model at a time
};
StrictJson to_json(Order const& order);
Order order_from(StrictJson const& json);

/// Does the work that the guard orders over kOrders, and reports over kEvents. Does not return before all is said; ends
/// the process when the guard is gone.
int run_worker(Work work);

}  // namespace vitrine::graph
