// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Events of the work as messages: what the worker sends, and what the guard makes of them.

#include "graph/strict_json.h"
#include "graph/work.h"

#include <functional>

namespace vitrine::graph {

/// Events that are sent as they come.
WorkEvents sending(std::function<void(StrictJson const&)> const& send);

/// Calls the event that a message stands for. False where it stands for none.
bool deliver(StrictJson const& message, WorkEvents const& events);

}  // namespace vitrine::graph
