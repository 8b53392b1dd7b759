// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Requests to stop, as something that can be waited for.

namespace vitrine::graph {

/// From here on SIGINT, SIGTERM, SIGHUP and SIGCHLD no longer interrupt, and SIGPIPE is ignored: reports are written
/// whole.
class Signals {
 public:
  Signals();
  ~Signals();
  Signals(Signals const&) = delete;
  Signals& operator=(Signals const&) = delete;

  int descriptor() const { return descriptor_; }
  int take();  ///< the next one; 0: none

 private:
  int descriptor_;
};

}  // namespace vitrine::graph
