// SPDX-License-Identifier: Apache-2.0
#include "graph/child.h"

#include "graph/wire.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <fstream>
#include <system_error>

namespace vitrine::graph {
namespace {

[[noreturn]] void fail(char const* what, int reason) {
  throw std::system_error(std::error_code(reason, std::generic_category()), what);
}

/// Two ends of a pipe, out of the way of the numbers that the worker's ends get.
struct Pipe {
  int read = -1, write = -1;
  Pipe() {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) fail("cannot make a pipe", errno);
    read = ::fcntl(ends[0], F_DUPFD_CLOEXEC, 10);
    write = ::fcntl(ends[1], F_DUPFD_CLOEXEC, 10);
    ::close(ends[0]);
    ::close(ends[1]);
  }
};

void do_not_wait(int pipe) { ::fcntl(pipe, F_SETFL, O_NONBLOCK); }

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> all;
  for (std::string& text : texts) all.push_back(text.data());
  all.push_back(nullptr);
  return all;
}

std::vector<std::string> environment() {
  std::vector<std::string> all{std::string(kWorkerVariable) + "=1"};
  for (char** variable = environ; *variable; ++variable) all.emplace_back(*variable);
  return all;
}

/// posix_spawn's settings: default signals, a process group of its own.
struct Attributes {
  posix_spawnattr_t value;
  Attributes() {
    posix_spawnattr_init(&value);
    posix_spawnattr_setflags(&value, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    posix_spawnattr_setpgroup(&value, 0);
    sigset_t none, all;
    sigemptyset(&none);
    sigfillset(&all);
    posix_spawnattr_setsigmask(&value, &none);
    posix_spawnattr_setsigdefault(&value, &all);
  }
  ~Attributes() { posix_spawnattr_destroy(&value); }
};

struct Files {
  posix_spawn_file_actions_t value;
  Files() { posix_spawn_file_actions_init(&value); }
  ~Files() { posix_spawn_file_actions_destroy(&value); }
  void give(int descriptor, int as) { posix_spawn_file_actions_adddup2(&value, descriptor, as); }
};

}  // namespace

Child::Child(std::vector<std::string> const& arguments, int lock) {
  Pipe const orders, events, log;
  orders_ = orders.write;
  events_ = events.read;
  log_ = log.read;
  int const held = ::fcntl(lock, F_DUPFD_CLOEXEC, 10);
  Attributes const attributes;
  Files files;
  files.give(orders.read, kOrders);
  files.give(events.write, kEvents);
  files.give(held, kHeldLock);
  files.give(log.write, STDOUT_FILENO);
  files.give(log.write, STDERR_FILENO);
  std::vector<std::string> texts = arguments, variables = environment();
  int const failed = posix_spawn(&pid_, "/proc/self/exe", &files.value, &attributes.value, pointers(texts).data(),
                                 pointers(variables).data());
  for (int descriptor : {orders.read, events.write, log.write, held}) ::close(descriptor);
  if (failed) {
    pid_ = -1;
    fail("cannot start the worker", failed);
  }
  do_not_wait(events_);
  do_not_wait(log_);
}

Child::~Child() {
  if (!status()) {
    kill();
    ::waitpid(pid_, nullptr, 0);
  }
  for (int descriptor : {orders_, events_, log_}) ::close(descriptor);
}

void Child::kill() const { ::kill(-pid_, SIGKILL); }

std::optional<int> Child::status() {
  int status = 0;
  if (!status_ && ::waitpid(pid_, &status, WNOHANG) == pid_) {
    status_ = status;
    kill();  // what it may have left behind
  }
  return status_;
}

std::uint64_t Child::memory() const {
  std::ifstream file("/proc/" + std::to_string(pid_) + "/status");
  std::uint64_t sum = 0, kib = 0;
  for (std::string key; file >> key; file.ignore(1 << 12, '\n'))
    if ((key == "RssAnon:" || key == "RssShmem:") && file >> kib) sum += kib * 1024;
  return sum;
}

std::string describe_status(int status) {
  if (WIFSIGNALED(status)) {
    int const signal = WTERMSIG(status);
    char const* const name = sigabbrev_np(signal);
    return std::string("killed by SIG") + (name ? name : std::to_string(signal).c_str()) + " (" + sigdescr_np(signal) +
           ")";
  }
  return "left with exit code " + std::to_string(WEXITSTATUS(status)) + " in the middle of its work";
}

}  // namespace vitrine::graph
