// SPDX-License-Identifier: Apache-2.0
// A run that nobody has to watch: whatever happens to it, the same command again ends with the same gallery, and one bad
// model costs that model alone. VITRINE_NIGHT=full repeats what is random a hundred times more often.
#include "tests/support/folders.h"
#include "tests/support/meshes.h"
#include "tests/support/program.h"

#include "io/lock.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <csignal>
#include <cstdlib>
#include <random>
#include <set>
#include <thread>

namespace vitrine {
namespace {

namespace fs = std::filesystem;
using test::Outcome;
using test::Program;
using testing::HasSubstr;
using namespace std::chrono_literals;

int times(int few, int full) {
  char const* const wanted = std::getenv("VITRINE_NIGHT");
  return wanted && std::string(wanted) == "full" ? full : few;
}

using Arguments = std::vector<std::string>;

class Night : public testing::Test {
 protected:
  fs::path at(std::string const& name) const { return folder_.path() / name; }

  void add(std::string const& name, int seed = 0) {
    test::write_file(at("archive") / name, test::obj_text(test::painted_model(test::bumpy_sphere(16, 8, unsigned(seed)))));
  }
  void add_good(int count) {
    for (int i = 0; i < count; ++i) add("good" + std::to_string(i) + ".obj", i);
  }

  Arguments convert(std::string const& gallery, Arguments const& more = {}) const {
    Arguments all{VITRINE_PROGRAM, "convert", at("archive"), "--out", at(gallery), "--triangles", "60", "--texture", "16",
                  "--viewport", "16"};
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
  nlohmann::json report(std::string const& gallery) const { return nlohmann::json::parse(test::read_file(at(gallery) / "report.json")); }
  int converted(std::string const& gallery) const { return report(gallery)["run"]["converted"]; }

  /// The same command until it says that all is done.
  void go_on(std::string const& gallery, int most = 1) const {
    Outcome last;
    for (int i = 0; i < most && last.code != 0; ++i) last = run(convert(gallery));
    ASSERT_EQ(last.code, 0) << last.output;
  }
  /// Models whose certificate stands: they need no further work.
  std::map<std::string, fs::file_time_type> finished(std::string const& gallery) const {
    std::map<std::string, fs::file_time_type> found;
    std::error_code error;
    for (fs::directory_iterator it(at(gallery) / "models", error), end; !error && it != end; it.increment(error))
      if (fs::path const file = it->path() / "certificate.json"; fs::exists(file)) found[it->path().filename()] = fs::last_write_time(file);
    return found;
  }
  /// After whatever happened: no model is done twice, nothing half-written stands, the gallery becomes what it should be.
  void expect_recovery(std::string const& gallery, std::map<std::string, std::string> const& expected) const {
    for (auto const& [name, bytes] : test::published(at(gallery)))
      if (name.starts_with("models/") && !name.ends_with(".vitrine-unfinished")) {
        EXPECT_EQ(bytes, expected.at(name)) << name;
      }
    auto const before = finished(gallery);
    ASSERT_NO_FATAL_FAILURE(go_on(gallery));
    EXPECT_EQ(test::published(at(gallery)), expected);
    auto const after = finished(gallery);
    for (auto const& [slug, time] : before) EXPECT_EQ(after.at(slug), time) << slug << " was made again";
  }

 private:
  test::TemporaryFolder folder_;
};

TEST_F(Night, TheSameCommandAgainDoesNothing) {
  add_good(3);
  ASSERT_EQ(run(convert("g")).code, 0);
  auto const expected = test::published(at("g"));
  auto const before = finished("g");
  EXPECT_EQ(before.size(), 3u);
  go_on("g");
  EXPECT_EQ(converted("g"), 0);
  EXPECT_EQ(finished("g"), before);
  EXPECT_EQ(test::published(at("g")), expected);
  ASSERT_EQ(run(convert("g", {"--verify"})).code, 0);
  EXPECT_EQ(converted("g"), 0);
}

TEST_F(Night, ALedgerThatIsLostOrDamagedIsRebuiltFromTheCertificates) {
  add_good(2);
  ASSERT_EQ(run(convert("g")).code, 0);
  auto const expected = test::published(at("g"));
  fs::remove_all(at("g") / ".vitrine");
  go_on("g");
  EXPECT_EQ(converted("g"), 0);
  EXPECT_EQ(test::published(at("g")), expected);
  test::write_file(at("g") / ".vitrine/ledger.sqlite", std::string(20000, 'x'));
  go_on("g");
  EXPECT_EQ(converted("g"), 0);
  EXPECT_EQ(test::published(at("g")), expected);
}

TEST_F(Night, WhatHasChangedIsDoneAgainAndNothingElse) {
  add_good(3);
  test::write_file(at("archive") / "named.obj", "mtllib named.mtl\n" + test::obj_text(test::plain_model(test::cube())));
  ASSERT_EQ(run(convert("g")).code, 0);
  auto const changes = [&](int count, Arguments const& more = {}) {
    ASSERT_EQ(run(convert("g", more)).code, 0);
    EXPECT_EQ(converted("g"), count);
  };
  add("good1.obj", 7);
  changes(1);
  test::write_file(at("archive") / "named.mtl", "newmtl red\nKd 1 0 0\n");  // was missing
  changes(1);
  fs::remove(at("archive") / "named.mtl");
  changes(1);
  test::write_file(at("archive") / "archive.csv", "path,title,credit\ngood0.obj,New title,Somebody\n");
  changes(1);
  test::write_file(at("archive") / "archive.csv", "path,title,credit\ngood0.obj,New title,Somebody else\n");
  changes(0);
  EXPECT_THAT(test::read_file(at("g") / "gallery.json"), HasSubstr("Somebody else"));
  changes(4, {"--normal-codec", "png"});
  changes(4);
  fs::remove(at("g") / std::string(report("g")["rows"][0]["thumb"]));
  changes(1);
}

TEST_F(Night, OptionsThatWriteLessLeaveNothingOfWhatTheyWroteBefore) {
  add_good(1);
  ASSERT_EQ(run(convert("plain")).code, 0);
  ASSERT_EQ(run(convert("g", {"--series", "--x3dom"})).code, 0);
  ASSERT_TRUE(fs::exists(at("g") / std::string(report("g")["rows"][0]["seriesFolder"])));
  go_on("g");
  EXPECT_EQ(test::published(at("g")), test::published(at("plain")));
}

TEST_F(Night, ModelsThatLeftTheArchiveStayUntilPruned) {
  add_good(2);
  ASSERT_EQ(run(convert("g")).code, 0);
  fs::remove(at("archive") / "good0.obj");
  EXPECT_THAT(run(convert("g")).output, HasSubstr("--prune"));
  EXPECT_EQ(finished("g").size(), 2u);
  EXPECT_EQ(report("g")["models"], 1);
  ASSERT_EQ(run(convert("g", {"--prune"})).code, 0);
  EXPECT_EQ(finished("g").size(), 1u);
}

TEST_F(Night, ASecondRunIsTurnedAway) {
  add_good(1);
  io::Lock const lock(at("g") / ".vitrine/lock");
  ASSERT_TRUE(lock.held());
  EXPECT_EQ(run(convert("g")).code, 11);
}

TEST_F(Night, FailuresAreRememberedUntilTheModelChangesOrRetryIsAsked) {
  add_good(1);
  test::write_file(at("archive") / "bad.ply", "no PLY");
  Outcome outcome = run(convert("g"));
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.output, HasSubstr("1 of them new"));
  EXPECT_EQ(report("g")["run"]["newFailures"][0], "bad.ply");
  outcome = run(convert("g"));
  EXPECT_EQ(outcome.code, 3);
  EXPECT_EQ(converted("g"), 0);
  EXPECT_EQ(report("g")["run"]["knownFailures"][0], "bad.ply");
  EXPECT_EQ(run("retry", "g").code, 3);
  EXPECT_EQ(converted("g"), 1);
  EXPECT_EQ(report("g")["run"]["knownFailures"][0], "bad.ply") << "it is no new one";
  EXPECT_THAT(run("why", "g", {"bad"}).output, HasSubstr("no PLY file"));
  EXPECT_THAT(run("status", "g").output, HasSubstr("bad.ply: failed"));
}

TEST_F(Night, CheckFindsAFlippedBitAndVerifyMends) {
  add_good(2);
  ASSERT_EQ(run(convert("g")).code, 0);
  auto const expected = test::published(at("g"));
  EXPECT_EQ(run("check", "g").code, 0);
  for (char const* file : {"thumb.glb", "poster.jpg", "certificate.json"}) {
    fs::path const path = at("g") / "models" / finished("g").begin()->first / file;
    std::string bytes = test::read_file(path);
    bytes[bytes.size() / 2] ^= 1;
    test::write_file(path, bytes);
    EXPECT_EQ(run("check", "g").code, 4) << file;
    ASSERT_EQ(run(convert("g", {"--verify"})).code, 0);
    EXPECT_EQ(test::published(at("g")), expected) << file;
  }
}

TEST_F(Night, ARehearsalWritesNothing) {
  add_good(2);
  Outcome const outcome = run(convert("g", {"--dry-run"}));
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.output, HasSubstr("2 of 2 models would be converted"));
  EXPECT_FALSE(fs::exists(at("g")));
}

TEST_F(Night, AllThatHappensCanBeFollowed) {
  add_good(1);
  ASSERT_EQ(run(convert("g", {"--log", at("log")})).code, 0);
  std::istringstream lines(test::read_file(at("log")));
  std::set<std::string> events;
  for (std::string line; std::getline(lines, line);) events.insert(nlohmann::json::parse(line).at("event"));
  EXPECT_THAT(events, testing::IsSupersetOf({"archive", "confined", "stage", "done", "end"}));
  EXPECT_EQ(nlohmann::json::parse(test::read_file(at("g") / ".vitrine/status.json"))["state"], "complete");
}

TEST_F(Night, NamesAreDataInTheReport) {
  test::write_file(at("archive") / "<script>alert(1)<\x1b[31m>.ply", "no PLY");
  EXPECT_EQ(run(convert("g")).code, 3);
  std::string const page = test::read_file(at("g") / "report.html");
  EXPECT_THAT(page, HasSubstr("&lt;script&gt;"));
  EXPECT_THAT(page, testing::Not(HasSubstr("<script")));
  EXPECT_THAT(page, testing::Not(HasSubstr("\x1b")));
  for (char const* verb : {"status", "check"}) EXPECT_THAT(run(verb, "g").output, testing::Not(HasSubstr("\x1b")));
}

TEST_F(Night, ASignalEndsItAndTheSameCommandGoesOn) {
  add_good(6);
  ASSERT_EQ(run(convert("whole")).code, 0);
  auto const expected = test::published(at("whole"));
  Program program(convert("g", {"--threads", "1"}), at("output"));
  while (finished("g").empty() && !program.wait_for(1ms)) {
  }
  program.signal(SIGTERM);
  int const code = program.wait().code;
  EXPECT_THAT(code, testing::AnyOf(75, 0));
  if (code == 75) {
    EXPECT_THAT(test::read_file(at("g") / "report.json"), HasSubstr("\"pending\""));
  }
  expect_recovery("g", expected);
}

#ifdef VITRINE_FAULTS

struct FaultModel {
  std::string fault, reason;
};

TEST_F(Night, AModelThatTakesTheProgramDownCostsItselfAlone) {
  std::vector<FaultModel> const models = {
      {"segv@load", "SIGSEGV"},         {"abort@survey", "SIGABRT"},          {"overflow@simplify", "SIGSEGV"},
      {"loop@bake", "no progress"},     {"sleep@load", "no progress"},        {"fork@load", "cannot start a process"},
      {"alloc@survey", "out of memory"}, {"leak@load", "memory"},             {"exit@encode", "exit code 0"},
      {"garble@result", "glTF"},        {"close@load", "closed"},             {"throw@pack", "unknown type"}};
  add_good(times(4, 100));
  ASSERT_EQ(run(convert("without")).code, 0);
  auto const good = test::published(at("without"));
  std::string faults = "VITRINE_FAULT=";
  for (std::size_t i = 0; i < models.size(); ++i) {
    std::string const name = "x" + std::to_string(i) + ".obj";
    add(name, int(i));
    faults += models[i].fault + "/" + name + ";";
  }
  Outcome const outcome = run(convert("g", {"--stall-limit", "6", "--memory", "700MB"}), {faults});
  EXPECT_EQ(outcome.code, 3) << outcome.output;
  std::map<std::string, std::string> reasons;
  nlohmann::json const told = report("g");
  for (auto const& row : told["rows"])
    if (row["status"] != "done") reasons[row["input"]] = row["reason"];
  EXPECT_EQ(reasons.size(), models.size()) << outcome.output;
  for (std::size_t i = 0; i < models.size(); ++i)
    EXPECT_THAT(reasons["x" + std::to_string(i) + ".obj"], HasSubstr(models[i].reason)) << models[i].fault;
  auto const all = test::published(at("g"));
  for (auto const& [name, bytes] : good)
    if (name.starts_with("models/")) {
      EXPECT_EQ(all.at(name), bytes) << name;
    }
  EXPECT_THAT(run("why", "g", {"x0.obj"}).output, HasSubstr("quarantined"));

  ASSERT_EQ(run("retry", "g", {"--quarantined"}).code, 0) << "without faults";
}

TEST_F(Night, KilledAnywhereItGoesOn) {
  add_good(4);
  ASSERT_EQ(run(convert("whole")).code, 0);
  auto const expected = test::published(at("whole"));
  std::vector<std::string> points = {"guard:spawned", "guard:buried", "ledger:before", "ledger:after#2", "reports:before",
                                     "reports:between", "worker:begin", "worker:end", "load", "encode#2",
                                     "certify", "publish#2", "write#3", "fsync#5", "rename#4", "renamed#6", "renamed#9"};
  int const step = times(3, 1);
  for (std::size_t i = 0; i < points.size(); i += std::size_t(step)) {
    SCOPED_TRACE(points[i]);
    std::string const gallery = "killed" + std::to_string(i), marks = at(gallery + "-marks");
    fs::create_directories(marks);
    run(convert(gallery), {"VITRINE_FAULT=kill@" + points[i], "VITRINE_FAULT_ONCE=" + marks});
    expect_recovery(gallery, expected);
  }
}

TEST_F(Night, AnErrorOfTheDiskAtAnyCallLosesNoModel) {
  add_good(2);
  ASSERT_EQ(run(convert("whole")).code, 0);
  auto const expected = test::published(at("whole"));
  for (std::string const call : {"write", "fsync", "rename"})
    for (std::string const error : {"enospc", "eio"})
      for (int n = 1, code = -1; code != 0; n += times(11, 1)) {
        SCOPED_TRACE(error + "@" + call + "#" + std::to_string(n));
        ASSERT_LT(n, 200);
        std::string const gallery = error + call + std::to_string(n);
        code = run(convert(gallery), {"VITRINE_FAULT=" + error + "@" + call + "#" + std::to_string(n)}).code;
        EXPECT_THAT(code, testing::AnyOf(0, error == "enospc" ? 5 : 6));
        expect_recovery(gallery, expected);
      }
}

#endif

TEST_F(Night, KilledAtAnyMomentItGoesOn) {
  add_good(4);
  ASSERT_EQ(run(convert("whole")).code, 0);
  auto const expected = test::published(at("whole"));
  std::mt19937 random(7);
  for (int i = 0, count = times(6, 200); i < count; ++i) {
    std::string const gallery = "killed" + std::to_string(i);
    Program program(convert(gallery), at("output"));
    program.wait_for(std::chrono::milliseconds(std::uniform_int_distribution<>(0, 1200)(random)));
    pid_t const worker = program.child();
    if (i % 3 != 0 && worker > 0) ::kill(worker, SIGKILL);  // of guard, worker and both
    if (i % 3 != 1) program.signal(SIGKILL);
    program.wait();
    std::this_thread::sleep_for(20ms);  // a worker whose guard is killed follows it
    SCOPED_TRACE(i);
    expect_recovery(gallery, expected);
    fs::remove_all(at(gallery));
  }
}

}  // namespace
}  // namespace vitrine
