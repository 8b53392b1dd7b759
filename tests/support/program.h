// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The program as a user starts it, and what it leaves in a gallery.

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace vitrine::test {

struct Outcome {
  int code = -1;       ///< of the exit; -1: a signal ended it
  std::string output;  ///< stdout and stderr
};

/// A program under way: in a process group of its own, which is killed with it.
class Program {
 public:
  /// `environment`: "NAME=value", in addition to this process's.
  Program(std::vector<std::string> arguments, std::filesystem::path output, std::vector<std::string> environment = {});
  ~Program();
  Program(Program const&) = delete;
  Program& operator=(Program const&) = delete;

  pid_t pid() const { return pid_; }
  pid_t child() const;  ///< the first one; 0: none
  void signal(int number) const;
  bool wait_for(std::chrono::milliseconds time);  ///< whether it has ended
  Outcome wait();

 private:
  pid_t pid_ = -1;
  std::filesystem::path output_;
  bool ended_ = false;
  int status_ = 0;
};

/// Every file of a gallery, by path: .vitrine/ apart, and without times and what tells of the run in the reports.
std::map<std::string, std::string> published(std::filesystem::path const& gallery);

}  // namespace vitrine::test
