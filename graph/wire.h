// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What guard and worker say to each other: values as CBOR, each behind its length, over pipes. Neither trusts the
/// other to be there, or to be sane.

#include "graph/strict_json.h"

#include <functional>
#include <string>

namespace vitrine::graph {

/// Where the worker finds its ends.
constexpr int kOrders = 3, kEvents = 4, kHeldLock = 5;

/// Waits until all is written. False when nobody reads any more.
bool send(int pipe, StrictJson const& value);

/// Puts together what arrives in pieces.
class Inbox {
 public:
  explicit Inbox(int pipe) : pipe_(pipe) {}
  /// Reads once, as much as there is; waits only if the pipe does. Hands on every value that is whole.
  /// False at the end of the pipe, and at bytes that are no message.
  bool read(std::function<void(StrictJson const&)> const& take);

 private:
  bool hand_on(std::function<void(StrictJson const&)> const& take);

  int pipe_;
  std::string bytes_;
};

}  // namespace vitrine::graph
