// SPDX-License-Identifier: Apache-2.0
#include "graph/worker.h"

#include "graph/child.h"
#include "graph/confinement.h"
#include "graph/events.h"
#include "graph/wire.h"
#include "io/fault.h"
#include "stages/error.h"

#include <sys/prctl.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <mutex>
#include <optional>
#include <thread>

namespace vitrine::graph {
namespace {

using json = StrictJson;
namespace fs = std::filesystem;

constexpr int kGuardIsGone = 70;

/// A worker without a guard has nobody to work for. If memory runs out, it is the one to go.
void depend_on_the_guard() {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  std::signal(SIGPIPE, SIG_IGN);
  std::ofstream("/proc/self/oom_score_adj") << 500;
}

void report(json const& message) {
  static std::mutex mutex;
  std::scoped_lock const lock(mutex);
  if (!send(kEvents, message)) ::_exit(kGuardIsGone);
}

/// Waits for the one order.
Order take_order(Inbox& orders) {
  std::optional<Order> order;
  while (!order)
    if (!orders.read([&](json const& message) { order = order_from(message); })) ::_exit(kGuardIsGone);
  return std::move(*order);
}

/// Whatever comes after the order means: begin nothing more. The end of the pipe means that the guard is gone.
void obey(Inbox& orders, std::stop_source& stop) {
  for (;;)
    if (!orders.read([&](json const&) { stop.request_stop(); })) ::_exit(kGuardIsGone);
}

json records_json(std::map<std::string, Record> const& records) {
  json out = json::object();
  for (auto const& [slug, record] : records) out[slug] = to_bytes(record);
  return out;
}

void say_confined(Work const& work, std::uint64_t memory) {
  Confinement const confined =
      confine(work.archive, work.run.gallery, memory,
              work.run.trace.empty() ? work.run.trace : fs::absolute(work.run.trace).parent_path());
  report({{"event", "confined"}, {"level", confined.level}, {"missing", confined.missing}});
}

}  // namespace

bool is_worker() { return std::getenv(kWorkerVariable) != nullptr; }

json to_json(Order const& order) {
  return {{"known", records_json(order.known)},
          {"settled", order.settled},
          {"unopened", order.unopened},
          {"only", order.only},
          {"memory", order.memory},
          {"alone", order.alone}};
}

Order order_from(json const& in) {
  Order order;
  for (auto const& [slug, bytes] : in.at("known").items())
    if (std::optional<Record> record = record_from(bytes)) order.known.emplace(slug, std::move(*record));
  order.settled = in.at("settled");
  order.unopened = in.at("unopened");
  order.only = in.at("only");
  order.memory = in.at("memory");
  order.alone = in.at("alone");
  return order;
}

int run_worker(Work work) {
  depend_on_the_guard();
  static Inbox orders(kOrders);
  static std::stop_source stop;
  Order order = take_order(orders);
  work.known = std::move(order.known);
  work.settled = std::move(order.settled);
  work.unopened = std::move(order.unopened);
  work.only = std::move(order.only);
  work.run.memory = order.memory;
  if (order.alone) work.run.models = 1;
  work.run.stop = stop.get_token();
  say_confined(work, order.memory);
  io::fault("worker:begin");
  std::thread([] { obey(orders, stop); }).detach();
  try {
    do_work(work, sending(report));
    io::fault("worker:end");
    report({{"event", "end"}});
  } catch (Error const& error) {
    report({{"event", "error"}, {"what", error.what()}, {"remedy", error.remedy()}});
  } catch (fs::filesystem_error const& error) {
    report({{"event", "error"}, {"what", error.what()}, {"remedy", "check its disk"}, {"machine", true}});
  }
  ::_exit(0);
}

}  // namespace vitrine::graph
