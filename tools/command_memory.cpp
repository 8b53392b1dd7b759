// SPDX-License-Identifier: Apache-2.0
#include "tools/command_memory.h"

#include "io/publish.h"
#include "stages/error.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <fstream>
#include <iterator>

namespace vitrine::tools {
namespace {

namespace fs = std::filesystem;

fs::path memory(fs::path const& gallery) { return gallery / ".vitrine/command.cbor"; }

std::string contents(fs::path const& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

bool parse_time(std::string const& text, int& hour, int& minute) {
  char rest = 0;
  return text.size() == 5 && std::sscanf(text.c_str(), "%2d:%2d%c", &hour, &minute, &rest) == 2 && hour >= 0 &&
         hour < 24 && minute >= 0 && minute < 60;
}

}  // namespace

std::vector<std::string> command_line() {
  std::string const all = contents("/proc/self/cmdline");  // each argument ends with a zero
  std::vector<std::string> arguments;
  for (std::size_t begin = 0, end; (end = all.find('\0', begin)) != std::string::npos; begin = end + 1)
    arguments.push_back(all.substr(begin, end - begin));
  return arguments;
}

void remember_command(fs::path const& gallery) {
  nlohmann::json const json = {{"arguments", command_line()}, {"folder", fs::current_path().native()}};
  std::string bytes;
  nlohmann::json::to_cbor(json, bytes);
  io::publish_file(memory(gallery), bytes);
}

Remembered remembered_command(fs::path const& gallery) try {
  nlohmann::json const json = nlohmann::json::from_cbor(contents(memory(gallery)));
  return {json.at("arguments"), json.at("folder").get<std::string>()};
} catch (nlohmann::json::exception const&) {
  throw Error(ErrorKind::invalid_input, "no command is remembered in " + gallery.string(),
              "run vitrine convert, as at first");
}

std::string check_time(std::string const& text) {
  int hour = 0, minute = 0;
  return parse_time(text, hour, minute) ? "" : "\"" + text + "\" is no time of day like 07:00";
}

std::chrono::system_clock::time_point next_time(std::string const& text, std::time_t now) {
  std::tm when{};
  localtime_r(&now, &when);
  parse_time(text, when.tm_hour, when.tm_min);
  when.tm_sec = 0;
  when.tm_isdst = -1;
  std::time_t next = std::mktime(&when);
  if (next <= now) {
    ++when.tm_mday;
    when.tm_isdst = -1;
    next = std::mktime(&when);
  }
  return std::chrono::system_clock::from_time_t(next);
}

}  // namespace vitrine::tools
