// SPDX-License-Identifier: Apache-2.0
#include "io/lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <thread>

namespace vitrine::io {

Lock::Lock(std::filesystem::path const& file, std::chrono::milliseconds patience) {
  std::filesystem::create_directories(file.parent_path());
  descriptor_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0)
    throw std::filesystem::filesystem_error("cannot make", file, std::error_code(errno, std::generic_category()));
  auto const end = std::chrono::steady_clock::now() + patience;
  while (!(held_ = ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
}

Lock::~Lock() { ::close(descriptor_); }

}  // namespace vitrine::io
