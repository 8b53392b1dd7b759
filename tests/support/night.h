// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the tests of a night share: an archive of small models, the program run over it, and what a gallery must be
/// like after whatever happened. Only for tests that are built with VITRINE_PROGRAM.

#include "tests/support/folders.h"
#include "tests/support/meshes.h"
#include "tests/support/program.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace vitrine::test {

/// How often something is done: with VITRINE_NIGHT=full, `full` times.
inline int times(int few, int full) {
  char const* const wanted = std::getenv("VITRINE_NIGHT");
  return wanted && std::string(wanted) == "full" ? full : few;
}

using Arguments = std::vector<std::string>;
using Files = std::map<std::string, std::string>;  ///< bytes by path

/// Names of the files that only one side has, or that differ.
inline std::vector<std::string> differing(Files const& a, Files const& b) {
  std::vector<std::string> names;
  for (auto const& [name, bytes] : a)
    if (auto const other = b.find(name); other == b.end() || other->second != bytes) names.push_back(name);
  for (auto const& [name, bytes] : b)
    if (!a.contains(name)) names.push_back(name);
  return names;
}

class Night : public testing::Test {
 protected:
  std::filesystem::path at(std::string const& name) const { return folder_.path() / name; }

  void add(std::string const& name, int seed = 0) const {
    write_file(at("archive") / name, obj_text(painted_model(bumpy_sphere(16, 8, unsigned(seed)))));
  }
  void add_good(int count) const {
    for (int i = 0; i < count; ++i) add("good" + std::to_string(i) + ".obj", i);
  }

  Arguments convert(std::string const& gallery, Arguments const& more = {}) const {
    Arguments all{VITRINE_PROGRAM, "convert", at("archive"), "--out", at(gallery), "--triangles", "60",
                  "--texture",     "16",      "--viewport",  "16"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  Outcome run(Arguments const& arguments, Arguments const& environment = {}) const {
    return Program(arguments, at("output"), environment).wait();
  }
  Outcome run(std::string const& verb, std::string const& gallery, Arguments const& more = {}) const {
    Arguments all{VITRINE_PROGRAM, verb, at(gallery)};
    all.insert(all.end(), more.begin(), more.end());
    return run(all);
  }
  nlohmann::json report(std::string const& gallery) const {
    return nlohmann::json::parse(read_file(at(gallery) / "report.json"));
  }
  int converted(std::string const& gallery) const { return report(gallery)["run"]["converted"]; }
  /// Of each model that is not done, by its path.
  std::map<std::string, std::string> reasons(std::string const& gallery) const {
    std::map<std::string, std::string> found;
    nlohmann::json const told = report(gallery);
    for (auto const& row : told["rows"])
      if (row["status"] != "done") found[row["input"]] = row["reason"];
    return found;
  }

  /// A run that nothing befalls.
  Files undisturbed(Arguments const& options = {}) const {
    Outcome const outcome = run(convert("undisturbed", options));
    EXPECT_EQ(outcome.code, 0) << outcome.output;
    return published(at("undisturbed"));
  }
  /// The same command until it says that all is done.
  void go_on(std::string const& gallery) const {
    Outcome const outcome = run(convert(gallery));
    ASSERT_EQ(outcome.code, 0) << outcome.output;
  }
  /// Models whose certificate stands: they need no further work.
  std::map<std::string, std::filesystem::file_time_type> finished(std::string const& gallery) const {
    std::map<std::string, std::filesystem::file_time_type> found;
    std::error_code error;
    for (std::filesystem::directory_iterator it(at(gallery) / "models", error), end; !error && it != end;
         it.increment(error))
      if (auto const file = it->path() / "certificate.json"; std::filesystem::exists(file))
        found[it->path().filename()] = std::filesystem::last_write_time(file);
    return found;
  }
  /// Each file that a visitor of the gallery could come across is whole.
  void expect_nothing_half_written(std::string const& gallery, Files const& expected) const {
    for (auto const& [name, bytes] : published(at(gallery)))
      if (name.starts_with("models/") && !name.ends_with(".vitrine-unfinished")) {
        ASSERT_TRUE(expected.contains(name)) << name;
        EXPECT_TRUE(bytes == expected.at(name)) << name;
      }
  }
  /// After whatever happened: no model is done twice, nothing half-written stands, the gallery becomes what it should
  /// be.
  void expect_recovery(std::string const& gallery, Files const& expected) const {
    expect_nothing_half_written(gallery, expected);
    auto const before = finished(gallery);
    ASSERT_NO_FATAL_FAILURE(go_on(gallery));
    EXPECT_THAT(differing(published(at(gallery)), expected), testing::IsEmpty());
    auto const after = finished(gallery);
    for (auto const& [slug, time] : before) EXPECT_EQ(after.at(slug), time) << slug << " was made again";
  }

 private:
  TemporaryFolder folder_;
};

}  // namespace vitrine::test
