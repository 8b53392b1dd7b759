// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A run as others can follow it: progress for people, .vitrine/status.json for monitors, JSON lines for programs.

#include "graph/night.h"
#include "graph/progress.h"
#include "graph/strict_json.h"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <string>

namespace vitrine::graph {

/// "2026-11-27T06:59:00Z"
std::string utc(std::int64_t milliseconds_since_1970);

class Chronicle {
 public:
  /// log: file that events are appended to; empty: none. live: stderr is a terminal.
  /// Errors: std::filesystem::filesystem_error when the log cannot be opened.
  Chronicle(Night const& night, std::filesystem::path const& gallery, std::filesystem::path const& log, bool live);

  void event(StrictJson const& message);  ///< as in wire.h
  void say(std::string const& line);      ///< printable already
  void converting();                      ///< from here on there is progress
  void left(Record const& record);
  void tick();  ///< writes status.json every few seconds
  /// The last word; `state` as in status.json: "complete", "interrupted", …
  void end(std::string const& state);

 private:
  double cost_of(std::string const& slug) const;
  StrictJson status(std::string const& state) const;
  void write_status(std::string const& state);

  Night const& night_;
  std::filesystem::path gallery_;
  std::ofstream log_;
  bool live_;
  std::optional<Progress> progress_;
  std::map<std::string, std::string> stages_;  ///< of the models under way, by slug
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now(), written_{};
};

}  // namespace vitrine::graph
