// SPDX-License-Identifier: Apache-2.0
#include "tests/support/program.h"

#include "tests/support/folders.h"

#include <nlohmann/json.hpp>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <regex>
#include <stdexcept>
#include <thread>

namespace vitrine::test {
namespace {

namespace fs = std::filesystem;

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> all;
  for (std::string& text : texts) all.push_back(text.data());
  all.push_back(nullptr);
  return all;
}

std::string without_times(std::string const& text) {
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(text);
  for (char const* key : {"seconds", "stages", "run", "cpuSeconds", "peakMemory"}) json.erase(key);
  for (auto& row : json["rows"]) row.erase("seconds"), row.erase("stages");
  return json.dump(1);
}

}  // namespace

Program::Program(std::vector<std::string> arguments, fs::path output, std::vector<std::string> environment)
    : output_(std::move(output)) {
  for (char** variable = environ; *variable; ++variable) environment.emplace_back(*variable);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, output_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_adddup2(&files, STDOUT_FILENO, STDERR_FILENO);
  std::string const program = arguments.front();
  int const failed =
      posix_spawn(&pid_, program.c_str(), &files, nullptr, pointers(arguments).data(), pointers(environment).data());
  posix_spawn_file_actions_destroy(&files);
  if (failed) throw std::runtime_error("cannot start " + program);
}

Program::~Program() {
  if (ended_) return;
  ::kill(pid_, SIGKILL);
  ::waitpid(pid_, nullptr, 0);
}

pid_t Program::child() const {
  std::ifstream file("/proc/" + std::to_string(pid_) + "/task/" + std::to_string(pid_) + "/children");
  pid_t found = 0;
  file >> found;
  return found;
}

void Program::signal(int number) const {
  if (!ended_) ::kill(pid_, number);
}

bool Program::wait_for(std::chrono::milliseconds time) {
  auto const end = std::chrono::steady_clock::now() + time;
  while (!ended_ && !(ended_ = ::waitpid(pid_, &status_, WNOHANG) == pid_) && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  return ended_;
}

Outcome Program::wait() {
  while (!wait_for(std::chrono::hours(1))) {
  }
  return {WIFEXITED(status_) ? WEXITSTATUS(status_) : -1, read_file(output_)};
}

std::map<std::string, std::string> published(fs::path const& gallery) {
  std::map<std::string, std::string> files;
  if (!fs::exists(gallery)) return files;
  for (auto it = fs::recursive_directory_iterator(gallery); it != fs::recursive_directory_iterator(); ++it) {
    std::string const name = fs::relative(it->path(), gallery);
    if (name == ".vitrine" || name == "viewer") it.disable_recursion_pending();
    if (!it->is_regular_file() || name == "index.html" || name == "report.html") continue;
    files[name] = read_file(it->path());
  }
  if (files.contains("report.json")) files["report.json"] = without_times(files["report.json"]);
  if (files.contains("report.csv"))
    files["report.csv"] =
        std::regex_replace(files["report.csv"], std::regex("[0-9]+\\.[0-9]{6},([^,]*)\r\n"), "TIME,$1\r\n");
  return files;
}

}  // namespace vitrine::test
