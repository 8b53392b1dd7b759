// SPDX-License-Identifier: Apache-2.0
// What fails around the models, disk and archive, is no model's fault: the run says so, and goes on once it is mended.
// With VITRINE_NIGHT=full an error at each call of the system in turn.
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
  std::vector<Call> const calls = {{"enospc", "write", 5},  {"eio", "rename", 6},   {"eio", "open", 6},
                                   {"enospc", "rename", 5}, {"enospc", "fsync", 5}, {"eio", "write", 6},
                                   {"eio", "fsync", 6}};
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
  Outcome const outcome =
      run(convert("g"), {"VITRINE_FAULT=bus@load/good0.obj"});  // as a mapped file that cannot be read
  EXPECT_EQ(outcome.code, 6) << outcome.output;
  EXPECT_THAT(reasons("g")["good0.obj"], HasSubstr("could not be read to its end"));
  expect_recovery("g", expected);
}

#endif

/// Runs a shell where a small file system can be mounted.
int elsewhere(std::string const& script) {
  return std::system(("unshare --user --map-root-user --mount sh -ec '" + script + "' > /dev/null 2>&1").c_str());
}

class SmallDisk : public Night {
 protected:
  void SetUp() override {
    fs::create_directories(at("small"));
    if (elsewhere(mount()) != 0) GTEST_SKIP() << "no file system can be mounted here";
  }
  /// A run on a file system with this limit is told that the disk is full, and goes on when it has been enlarged.
  void expect_stop_and_recovery(std::string const& limit, std::string const& enlarged,
                                test::Arguments const& options = {}) const {
    SCOPED_TRACE(limit);
    std::string command;
    for (std::string const& word : convert("small/g", options)) command += word + " ";
    std::string const gallery = at("small/g");
    EXPECT_EQ(elsewhere(mount() + " -o " + limit + "; set +e; " + command + "; [ $? = 5 ] || exit 1; ls " + gallery +
                        "/models | wc -l > " + at("reached").string() + "; mount -o remount," + enlarged + " " +
                        at("small").string() + "; " + command + "; [ $? = 0 ] || exit 2; cp -r " + gallery + " " +
                        at(limit).string()),
              0);
    EXPECT_THAT(test::differing(test::published(at(limit)), undisturbed(options)), testing::IsEmpty());
  }
  int reached() const { return std::stoi(test::read_file(at("reached"))); }  ///< models, before the disk was full

 private:
  std::string mount() const { return "mount -t tmpfs none " + at("small").string(); }
};

TEST_F(SmallDisk, FullInTheMiddleOfAModelOrFromTheStart) {
  add_good(12);
  expect_stop_and_recovery("nr_inodes=30", "nr_inodes=1000");
  EXPECT_GT(reached(), 0);
  expect_stop_and_recovery("size=15m", "size=64m");  // below the reserve
  EXPECT_EQ(reached(), 0);
}

TEST_F(SmallDisk, OfSixtyFourMegabytesFillsUp) {
  if (times(0, 1) == 0) GTEST_SKIP() << "takes a minute";
  int const models = 100;
  add_good(models);
  expect_stop_and_recovery("size=64m", "size=1g", {"--series", "--series-rows", "8"});  // 256 files for each model
  EXPECT_GT(reached(), 10);
  EXPECT_LT(reached(), models);
}

}  // namespace
}  // namespace vitrine
