// SPDX-License-Identifier: Apache-2.0
#include "io/fault.h"

#ifdef VITRINE_FAULTS

#include "stages/error.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace vitrine::io {
namespace {

struct Rule {
  std::string text, action, point, of;
  int nth = 1;
};

Rule parsed(std::string const& text) {
  Rule rule{text, {}, {}, {}};
  std::string rest = text;
  if (std::size_t const hash = rest.rfind('#'); hash != std::string::npos) {
    rule.nth = std::atoi(rest.c_str() + hash + 1);
    rest.resize(hash);
  }
  std::size_t const at = rest.find('@');
  rule.action = rest.substr(0, at);
  rest = at == std::string::npos ? "" : rest.substr(at + 1);
  std::size_t const slash = rest.find('/');
  rule.point = rest.substr(0, slash);
  if (slash != std::string::npos) rule.of = rest.substr(slash + 1);
  return rule;
}

std::vector<Rule> const& rules() {
  static std::vector<Rule> const all = [] {
    std::vector<Rule> found;
    char const* const given = std::getenv("VITRINE_FAULT");
    std::string rest = given ? given : "";
    while (!rest.empty()) {
      std::size_t const end = rest.find(';');
      if (end != 0) found.push_back(parsed(rest.substr(0, end)));
      rest = end == std::string::npos ? "" : rest.substr(end + 1);
    }
    return found;
  }();
  return all;
}

/// Whether nobody has taken this rule before.
bool take(Rule const& rule) {
  char const* const folder = std::getenv("VITRINE_FAULT_ONCE");
  if (!folder) return true;
  std::string name = rule.text;
  std::replace(name.begin(), name.end(), '/', '_');
  int const mark = ::open((std::string(folder) + "/" + name).c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0600);
  if (mark >= 0) ::close(mark);
  return mark >= 0;
}

/// The action that is due here.
std::optional<std::string> due(std::string_view point, std::string_view of) {
  static std::mutex mutex;
  static std::map<std::string, int> hits;
  for (Rule const& rule : rules()) {
    if (rule.point != point || (!rule.of.empty() && rule.of != of)) continue;
    std::scoped_lock const lock(mutex);
    if (++hits[rule.text] == rule.nth && take(rule)) return rule.action;
  }
  return std::nullopt;
}

unsigned volatile sink = 0;  // unsigned: it may run over

[[gnu::noinline]] int overflow(int depth) {
  char volatile frame[4096];
  frame[0] = char(depth);
  return depth < 0 ? 0 : overflow(depth + 1) + frame[0];
}

[[noreturn]] void sleep_for_ever() {
  for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
}

[[noreturn]] void use_up_memory(std::size_t step, std::chrono::milliseconds pause) {
  for (;;) {
    char* const block = static_cast<char*>(std::malloc(step));
    if (!block) throw std::bad_alloc();
    std::memset(block, 1, step);
    sink = sink + unsigned(block[step / 2]);
    std::this_thread::sleep_for(pause);
  }
}

void start_a_process() {
  pid_t const child = ::fork();
  if (child == 0) sleep_for_ever();
  if (child < 0)
    throw Error(ErrorKind::broken, std::string("cannot start a process: ") + std::strerror(errno), "this is a test");
  ::waitpid(child, nullptr, 0);
}

void act(std::string const& action) {
  using namespace std::chrono_literals;
  if (action == "kill") ::raise(SIGKILL);
  if (action == "segv") ::raise(SIGSEGV);
  if (action == "bus") ::raise(SIGBUS);
  if (action == "abort") std::abort();
  if (action == "overflow") sink = unsigned(overflow(0));
  if (action == "loop")
    for (;;) sink = sink + 1;
  if (action == "sleep") sleep_for_ever();
  if (action == "fork") start_a_process();
  if (action == "alloc") use_up_memory(std::size_t(100) << 30, 0ms);
  if (action == "leak") use_up_memory(64 << 20, 1ms);
  if (action == "exit") ::_exit(0);
  if (action == "close") ::close(4), sleep_for_ever();
  if (action == "throw") throw 42;
}

}  // namespace

void fault(std::string_view point, std::string_view of) {
  if (std::optional<std::string> const action = due(point, of)) act(*action);
}

int injected_error(std::string_view point) {
  std::optional<std::string> const action = due(point, {});
  if (!action) return 0;
  act(*action);
  return *action == "enospc" ? ENOSPC : *action == "eio" ? EIO : 0;
}

void garble(std::string_view point, std::string_view of, std::vector<std::byte>& bytes) {
  if (due(point, of) == "garble")
    for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = std::byte(i * 167 + 13);
}

}  // namespace vitrine::io

#else

namespace vitrine::io {

void fault(std::string_view, std::string_view) {}
int injected_error(std::string_view) { return 0; }
void garble(std::string_view, std::string_view, std::vector<std::byte>&) {}

}  // namespace vitrine::io

#endif
