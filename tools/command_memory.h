// SPDX-License-Identifier: Apache-2.0
#pragma once
/// This program's command line: as it is, as the gallery remembers it, and the times that it names.

#include <chrono>
#include <ctime>
#include <filesystem>
#include <string>
#include <vector>

namespace vitrine::tools {

/// With the program's name first.
std::vector<std::string> command_line();

/// Writes it down in the gallery, for retry_command.
void remember_command(std::filesystem::path const& gallery);

/// The command that made the gallery, and the folder it was given in. Errors: InvalidInput where none is remembered.
struct Remembered {
  std::vector<std::string> arguments;
  std::filesystem::path folder;
};
Remembered remembered_command(std::filesystem::path const& gallery);

/// "" for a time of day like 07:00, else what is wrong with it.
std::string check_time(std::string const& text);
/// When it is that time next, by the local clock.
std::chrono::system_clock::time_point next_time(std::string const& text, std::time_t now);

}  // namespace vitrine::tools
