// SPDX-License-Identifier: Apache-2.0
// A run that nobody has to watch: the same command again does what is missing or has changed, and nothing else.
#include "tests/support/night.h"

#include "io/lock.h"

#include <set>
#include <sstream>

namespace vitrine {
namespace {

namespace fs = std::filesystem;
using test::Arguments;
using test::Night;
using test::Outcome;
using testing::HasSubstr;

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
  test::write_file(at("archive") / "archive.csv",
                   "path,title,credit,link\ngood0.obj,New title,Somebody else,https://museum.example/{eye}\n");
  changes(0);
  EXPECT_THAT(test::read_file(at("g") / "gallery.json"),
              AllOf(HasSubstr("Somebody else"), HasSubstr("https://museum.example/{eye}")));
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

}  // namespace
}  // namespace vitrine
