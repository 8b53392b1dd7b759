// SPDX-License-Identifier: Apache-2.0
// Each test confines a child of its own: it is for good.
#include "graph/confinement.h"

#include "tests/support/folders.h"

#include <gtest/gtest.h>
#include <seccomp.h>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <thread>

namespace vitrine::graph {
namespace {

namespace fs = std::filesystem;

class Confined : public testing::Test {
 protected:
  Confined() {
    for (char const* name : {"archive/model", "gallery/old", "elsewhere/secret"})
      test::write_file(folder_.path() / name, "x");
  }

  fs::path at(std::string const& name) const { return folder_.path() / name; }
  Confinement confine_here() const { return confine(at("archive"), at("gallery"), std::uint64_t(1) << 30); }

  /// Whether the file could be opened.
  bool opens(std::string const& name, int flags) const {
    int const file = ::open(at(name).c_str(), flags, 0600);
    if (file >= 0) ::close(file);
    return file >= 0;
  }

  /// Runs in a child, confined; it is well if what it returns holds there.
  template <class Test>
  void expect_in_child(Test const& holds) const {
    pid_t const child = ::fork();
    if (child == 0) ::_exit(holds(confine_here()) ? 0 : 1);
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  }

 private:
  test::TemporaryFolder folder_;
};

bool has(Confinement const& found, char const* what) { return found.level.find(what) != std::string::npos; }

TEST_F(Confined, ItReadsTheArchiveAndWritesTheGalleryAndLittleElse) {
  expect_in_child([&](Confinement const& found) {
    if (!has(found, "landlock")) return has({found.missing, ""}, "landlock");
    return opens("archive/model", O_RDONLY) && opens("gallery/new", O_RDWR | O_CREAT) &&
           !opens("archive/model", O_RDWR) && !opens("archive/new", O_RDWR | O_CREAT) &&
           !opens("elsewhere/secret", O_RDONLY) && !opens("elsewhere/new", O_RDWR | O_CREAT) &&
           ::unlink(at("archive/model").c_str()) != 0;
  });
}

TEST_F(Confined, ItStartsThreadsButNoProcessAndNoConversation) {
  expect_in_child([&](Confinement const& found) {
    if (!has(found, "seccomp")) return has({found.missing, ""}, "seccomp");
    bool ran = false;
    std::thread([&] { ran = true; }).join();
    return ran && ::fork() < 0 && errno == EPERM && ::socket(AF_INET, SOCK_STREAM, 0) < 0 && errno == EPERM &&
           ::execl("/bin/true", "true", nullptr) < 0 && errno == EPERM &&
           ::symlink("a", at("gallery/link").c_str()) < 0;
  });
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kLimitsMemory = false;  // see confine()
#else
constexpr bool kLimitsMemory = true;
#endif

TEST_F(Confined, ItLeavesNoCoreFileAndHasALimitOnMemory) {
  expect_in_child([&](Confinement const&) {
    rlimit core{}, data{};
    ::getrlimit(RLIMIT_CORE, &core);
    ::getrlimit(RLIMIT_DATA, &data);
    return core.rlim_max == 0 && (data.rlim_max <= std::uint64_t(4) << 30) == kLimitsMemory;
  });
}

TEST_F(Confined, WhatTheKernelRefusesIsNamed) {
  pid_t const child = ::fork();
  if (child == 0) {
    scmp_filter_ctx const filter = seccomp_init(SCMP_ACT_ALLOW);
    int const call = seccomp_syscall_resolve_name("landlock_create_ruleset");
    seccomp_rule_add(filter, SCMP_ACT_ERRNO(ENOSYS), call > 0 ? call : 444, 0);
    seccomp_load(filter);
    Confinement const found = confine_here();
    ::_exit(has({found.missing, ""}, "landlock") && !has(found, "landlock") && has(found, "seccomp") ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

}  // namespace
}  // namespace vitrine::graph
