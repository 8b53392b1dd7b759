// SPDX-License-Identifier: Apache-2.0
// What fails around the models, disk and archive, is no model's fault: the run says so, and goes on once it is mended. With
// VITRINE_NIGHT=full an error at each call of the system in turn.
#include "tests/support/night.h"

#include <cstdlib>

namespace vitrine {
namespace {

namespace fs = std::filesystem;
using test::Night;
using test::Outcome;
using test::times;
using testing::HasSubstr;

#ifdef VITRINE_FAULTS

TEST_F(Night, AnErrorOfTheDiskAtAnyCallLosesNoModel) {
  add_good(2);
  auto const expected = undisturbed();
  struct Call {
    std::string error, name;
    int code;
  };
  std::vector<Call> const calls = {{"enospc", "write", 5}, {"eio", "rename", 6},  {"eio", "open", 6},
                                   {"enospc", "rename", 5}, {"enospc", "fsync", 5}, {"eio", "write", 6}, {"eio", "fsync", 6}};
  for (std::size_t i = 0; i < std::size_t(times(3, int(calls.size()))); ++i)
    for (int n = 1, code = -1; code != 0; n += times(9, 1)) {
      std::string const fault = calls[i].error + "@" + calls[i].name + "#" + std::to_string(n);
      SCOPED_TRACE(fault);
      ASSERT_LT(n, 200);
      Outcome const outcome = run(convert(fault), {"VITRINE_FAULT=" + fault});
      code = outcome.code;
      EXPECT_THAT(code, testing::AnyOf(0, calls[i].code)) << outcome.output;
      expect_recovery(fault, expected);
    }
}

TEST_F(Night, AnArchiveThatCannotBeReadIsNoModelsFault) {
  add_good(2);
  auto const expected = undisturbed();
  Outcome const outcome = run(convert("g"), {"VITRINE_FAULT=bus@load/good0.obj"});  // as a mapped file that cannot be read
  EXPECT_EQ(outcome.code, 6) << outcome.output;
  EXPECT_THAT(reasons("g")["good0.obj"], HasSubstr("could not be read to its end"));
  expect_recovery("g", expected);
}

#endif

/// Runs a shell where a small file system can be mounted.
int elsewhere(std::string const& script) {
  return std::system(("unshare --user --map-root-user --mount sh -ec '" + script + "' > /dev/null 2>&1").c_str());
}

TEST_F(Night, AFullFileSystemStopsItAndALargerOneLetsItGoOn) {
  add_good(12);
  fs::create_directories(at("small"));
  std::string const mount = "mount -t tmpfs none " + at("small").string();
  if (elsewhere(mount) != 0) GTEST_SKIP() << "no file system can be mounted here";
  auto const expected = undisturbed();
  std::string command;
  for (std::string const& word : convert("small/g")) command += word + " ";
  auto const filled = [&](std::string const& limit, std::string const& enlarged) {
    return elsewhere(mount + " -o " + limit + "; set +e; " + command + "; [ $? = 5 ] || exit 1; mount -o remount," + enlarged + " " + at("small").string() + "; " + command + "; [ $? = 0 ] || exit 2; cp -r " +
                     at("small/g").string() + " " + at(limit).string());
  };
  EXPECT_EQ(filled("nr_inodes=30", "nr_inodes=1000"), 0);  // full in the middle of a model
  EXPECT_THAT(test::differing(test::published(at("nr_inodes=30")), expected), testing::IsEmpty());
  EXPECT_EQ(filled("size=15m", "size=64m"), 0);  // below the reserve
  EXPECT_THAT(test::differing(test::published(at("size=15m")), expected), testing::IsEmpty());
}

}  // namespace
}  // namespace vitrine
