// SPDX-License-Identifier: Apache-2.0
#pragma once
/// All that is heard while a worker lives: what it says, what it prints, signals to the guard, and the clock.

#include "graph/child.h"
#include "graph/last_lines.h"
#include "graph/strict_json.h"

#include <chrono>
#include <functional>
#include <string>

namespace vitrine::graph {

struct Ears {
  std::function<void(StrictJson const& message)> said;
  std::function<void(std::string const& line)> printed;
  std::function<void()> signalled;  ///< `signals` can be read
  /// Several times a second. `deaf`: since when its line is closed although it lives; 0 while it is open.
  std::function<void(std::chrono::steady_clock::duration deaf)> between;
};

/// Until the child is dead and all it said is heard. Out: its status, as waitpid tells it; `lines` ends with its last ones.
int listen(Child& child, int signals, LastLines& lines, Ears const& ears);

}  // namespace vitrine::graph
