// SPDX-License-Identifier: Apache-2.0
#include "graph/signals.h"

#include <sys/signalfd.h>
#include <unistd.h>

#include <csignal>
#include <initializer_list>

namespace vitrine::graph {
namespace {

sigset_t ours() {
  sigset_t set;
  sigemptyset(&set);
  for (int signal : {SIGINT, SIGTERM, SIGHUP, SIGCHLD}) sigaddset(&set, signal);
  return set;
}

}  // namespace

Signals::Signals() {
  sigset_t const set = ours();
  ::sigprocmask(SIG_BLOCK, &set, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
  descriptor_ = ::signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK);
}

Signals::~Signals() { ::close(descriptor_); }

int Signals::take() {
  signalfd_siginfo info;
  return ::read(descriptor_, &info, sizeof info) == sizeof info ? int(info.ssi_signo) : 0;
}

}  // namespace vitrine::graph
