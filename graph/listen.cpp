// SPDX-License-Identifier: Apache-2.0
#include "graph/listen.h"

#include "graph/wire.h"

#include <poll.h>

#include <optional>

namespace vitrine::graph {

int listen(Child& child, int signals, LastLines& lines, Ears const& ears) {
  using Clock = std::chrono::steady_clock;
  constexpr int kTick = 200, kNone = -1;  // milliseconds; what poll passes over
  Inbox inbox(child.events());
  bool open = true, printing = true;
  Clock::time_point closed{};
  for (;;) {
    std::optional<int> const status = child.status();
    pollfd fds[] = {
        {open ? child.events() : kNone, POLLIN, 0}, {printing ? child.log() : kNone, POLLIN, 0}, {signals, POLLIN, 0}};
    ::poll(fds, 3, status ? 0 : kTick);
    if (fds[0].revents && !(open = inbox.read(ears.said))) closed = Clock::now();
    if (fds[1].revents) printing = lines.read(child.log(), ears.printed);
    if (fds[2].revents) ears.signalled();
    if (status && !(open && fds[0].revents) && !fds[1].revents) return *status;
    ears.between(open || status ? Clock::duration::zero() : Clock::now() - closed);
  }
}

}  // namespace vitrine::graph
