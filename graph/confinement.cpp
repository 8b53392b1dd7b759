// SPDX-License-Identifier: Apache-2.0
#include "graph/confinement.h"

#include <fcntl.h>
#include <linux/landlock.h>
#include <sched.h>
#include <seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <memory>
#include <string>

namespace vitrine::graph {
namespace {

namespace fs = std::filesystem;

void limit(int what, rlim_t value) {
  rlimit const both{value, value};
  ::setrlimit(what, &both);
}

// ---- Landlock: what can be reached in the file system

constexpr std::uint64_t kRead = LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR;
constexpr std::uint64_t kWrite = LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_REMOVE_DIR |
                                 LANDLOCK_ACCESS_FS_REMOVE_FILE | LANDLOCK_ACCESS_FS_MAKE_DIR |
                                 LANDLOCK_ACCESS_FS_MAKE_REG;
/// All that version 1 of Landlock can forbid.
constexpr std::uint64_t kAll = (LANDLOCK_ACCESS_FS_MAKE_SYM << 1) - 1;

class Ruleset {
 public:
  Ruleset() {
    landlock_ruleset_attr attributes{};
    attributes.handled_access_fs = kAll;
    descriptor_ = int(::syscall(SYS_landlock_create_ruleset, &attributes, sizeof attributes, 0));
  }
  ~Ruleset() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  Ruleset(Ruleset const&) = delete;
  Ruleset& operator=(Ruleset const&) = delete;

  void allow(fs::path const& below, std::uint64_t access) {
    int const folder = ::open(below.c_str(), O_PATH | O_CLOEXEC);
    if (folder < 0) return;
    landlock_path_beneath_attr rule{};
    rule.allowed_access = access;
    rule.parent_fd = folder;
    ::syscall(SYS_landlock_add_rule, descriptor_, LANDLOCK_RULE_PATH_BENEATH, &rule, 0);
    ::close(folder);
  }
  bool enforce() const { return descriptor_ >= 0 && ::syscall(SYS_landlock_restrict_self, descriptor_, 0) == 0; }

 private:
  int descriptor_;
};

bool confine_files(fs::path const& archive, fs::path const& gallery, fs::path const& more) {
  Ruleset rules;
  for (char const* system : {"/usr", "/lib", "/lib64", "/etc", "/proc", "/sys"}) rules.allow(system, kRead);
  for (char const* device : {"/dev/null", "/dev/zero", "/dev/random", "/dev/urandom"})
    rules.allow(device, LANDLOCK_ACCESS_FS_READ_FILE);
  std::error_code error;
  rules.allow(fs::read_symlink("/proc/self/exe", error), LANDLOCK_ACCESS_FS_READ_FILE);
  rules.allow(archive, kRead);
  rules.allow(gallery, kRead | kWrite);
  if (!more.empty()) rules.allow(more, kRead | kWrite);
  return rules.enforce();
}

// ---- seccomp: what can be asked of the kernel

// clang-format off
constexpr char const* kForbidden[] = {
    "execve", "execveat", "fork", "vfork", "socket", "socketpair", "connect", "bind", "listen", "ptrace",
    "process_vm_readv", "process_vm_writev", "mount", "umount2", "pivot_root", "chroot", "setns", "unshare",
    "init_module", "finit_module", "delete_module", "kexec_load", "bpf", "perf_event_open", "userfaultfd", "keyctl",
    "add_key", "reboot", "swapon", "swapoff", "symlink", "symlinkat", "link", "linkat", "mknod", "mknodat", "chmod",
    "fchmodat", "chown", "fchownat"};
// clang-format on

bool confine_calls() {
  std::unique_ptr<void, void (*)(scmp_filter_ctx)> const filter(seccomp_init(SCMP_ACT_ALLOW), seccomp_release);
  if (!filter) return false;
  for (char const* name : kForbidden)
    if (int const call = seccomp_syscall_resolve_name(name); call != __NR_SCMP_ERROR)
      seccomp_rule_add(filter.get(), SCMP_ACT_ERRNO(EPERM), call, 0);
  // Threads may be started, processes not. clone3 hides its flags from filters: the C library falls back to clone.
  seccomp_rule_add(filter.get(), SCMP_ACT_ERRNO(ENOSYS), SCMP_SYS(clone3), 0);
  seccomp_rule_add(filter.get(), SCMP_ACT_ERRNO(EPERM), SCMP_SYS(clone), 1,
                   SCMP_A0(SCMP_CMP_MASKED_EQ, CLONE_THREAD, 0));
  return seccomp_load(filter.get()) == 0;
}

void note(std::string& list, std::string const& what) { list += (list.empty() ? "" : ", ") + what; }

}  // namespace

Confinement confine(fs::path const& archive, fs::path const& gallery, [[maybe_unused]] std::uint64_t memory,
                    fs::path const& more) {
  Confinement done;
  limit(RLIMIT_CORE, 0);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // their shadow memory is larger than any limit
  limit(RLIMIT_DATA, 2 * memory + (rlim_t(2) << 30));
#endif
  note(done.level, "limits");
  if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0)
    note(done.level, "no-new-privs");
  else
    note(done.missing, std::string("no-new-privs (") + std::strerror(errno) + ")");
  long const version = ::syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
  if (version > 0 && confine_files(archive, gallery, more))
    note(done.level, "landlock " + std::to_string(version));
  else
    note(done.missing, std::string("landlock (") + std::strerror(errno) + ")");
  if (confine_calls())
    note(done.level, "seccomp");
  else
    note(done.missing, "seccomp");
  return done;
}

}  // namespace vitrine::graph
