// SPDX-License-Identifier: Apache-2.0
// Whatever ends a run, and whenever, nothing half-written stands in the gallery and the same command goes on. With
// VITRINE_NIGHT=full at every named point, and 200 times at random.
#include "tests/support/night.h"

#include <csignal>
#include <random>
#include <thread>

namespace vitrine {
namespace {

namespace fs = std::filesystem;
using test::Night;
using test::Program;
using test::times;
using testing::HasSubstr;
using namespace std::chrono_literals;

TEST_F(Night, KilledAtAnyMomentItGoesOn) {
  add_good(3);
  auto const expected = undisturbed();
  std::mt19937 random(7);
  for (int i = 0, count = times(6, 200); i < count; ++i) {
    SCOPED_TRACE(i);
    std::string const gallery = "killed" + std::to_string(i);
    Program program(convert(gallery), at("output"));
    program.wait_for(std::chrono::milliseconds(std::uniform_int_distribution<>(0, 1200)(random)));
    pid_t const worker = program.child();
    if (i % 3 != 0 && worker > 0) ::kill(worker, SIGKILL);  // of guard, worker and both
    if (i % 3 != 1) program.signal(SIGKILL);
    program.wait();
    std::this_thread::sleep_for(20ms);  // a worker whose guard is killed follows it
    expect_recovery(gallery, expected);
    fs::remove_all(at(gallery));
  }
}

TEST_F(Night, ASignalEndsItWithWhatIsUnderWayAndTheSameCommandGoesOn) {
  add_good(6);
  auto const expected = undisturbed();
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

TEST_F(Night, ASecondSignalEndsItAtOnce) {
  add_good(2);
  auto const expected = undisturbed();
  Program program(convert("g"), at("output"), {"VITRINE_FAULT=sleep@load/good0.obj"});
  while (finished("g").empty() && !program.wait_for(1ms)) {
  }
  program.signal(SIGINT);
  EXPECT_FALSE(program.wait_for(500ms)) << "one model is under way";
  program.signal(SIGINT);
  test::Outcome const outcome = program.wait();
  EXPECT_EQ(outcome.code, 75);
  EXPECT_THAT(outcome.output, HasSubstr("once more to stop at once"));
  expect_recovery("g", expected);
}

TEST_F(Night, KilledAtAnyPointItGoesOn) {
  add_good(3);
  auto const expected = undisturbed();
  std::vector<std::string> const points = {
      "guard:spawned", "reports:between", "rename#4",      "ledger:after#2", "worker:begin", "encode#2",  // in any run
      "guard:buried",  "reports:before",  "ledger:before", "worker:end",     "load",         "survey",  // in full ones
      "simplify",      "shape",           "segment",       "parameterize",   "pack",         "bake",     "weigh",
      "certify",       "publish#2",       "write#3",       "fsync#5",        "renamed#6",    "renamed#9"};
  for (std::size_t i = 0; i < std::size_t(times(6, int(points.size()))); ++i) {
    SCOPED_TRACE(points[i]);
    std::string const gallery = "killed" + std::to_string(i),
                      marks = at(gallery) / ".vitrine/marks";  // where a worker may write
    fs::create_directories(marks);
    run(convert(gallery), {"VITRINE_FAULT=kill@" + points[i], "VITRINE_FAULT_ONCE=" + marks});
    EXPECT_FALSE(fs::is_empty(marks)) << "no run comes to this point";
    expect_recovery(gallery, expected);
  }
}

#endif

}  // namespace
}  // namespace vitrine
