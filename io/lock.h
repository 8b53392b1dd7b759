// SPDX-License-Identifier: Apache-2.0
#pragma once
/// One run at a time.

#include <chrono>
#include <filesystem>

namespace vitrine::io {

/// Holds a file locked (flock) as long as it lives, and as long as a process lives that was started with its
/// descriptor.
class Lock {
 public:
  /// Makes the file and its folder. Somebody who is just about to let go of it is waited for as long as `patience`.
  /// Errors: std::filesystem::filesystem_error when that is not possible.
  explicit Lock(std::filesystem::path const& file, std::chrono::milliseconds patience = {});
  ~Lock();
  Lock(Lock const&) = delete;
  Lock& operator=(Lock const&) = delete;

  bool held() const { return held_; }  ///< false: somebody else has it
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_ = -1;
  bool held_ = false;
};

}  // namespace vitrine::io
