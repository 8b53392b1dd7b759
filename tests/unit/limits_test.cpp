// SPDX-License-Identifier: Apache-2.0
#include "graph/limits.h"

#include <gmock/gmock.h>

namespace vitrine::graph {
namespace {

using std::chrono::seconds;
using testing::HasSubstr;

constexpr std::chrono::steady_clock::time_point kBegin{};

std::optional<Sentence> after(seconds time, double stall, io::ArchiveEntry const* entry) {
  return Limits{0, stall}.hangs({{"vase", {"bake", kBegin}}}, kBegin + time, [&](std::string const&) { return entry; });
}

TEST(Limits, AModelMayTakeTheTimeOfItsSize) {
  io::ArchiveEntry large;
  large.estimate.triangles = 1'000'000;  // 200 s
  EXPECT_FALSE(after(seconds(500), 0, &large));
  ASSERT_TRUE(after(seconds(501), 0, &large));
  EXPECT_THAT(after(seconds(501), 0, &large)->reason, HasSubstr("no progress in 500 s"));
  EXPECT_FALSE(after(seconds(300), 0, nullptr));
  EXPECT_TRUE(after(seconds(301), 0, nullptr)) << "before the archive is known";
}

TEST(Limits, StallLimitGoesForModelsOfAnySize) {
  io::ArchiveEntry large;
  large.estimate.triangles = 1'000'000;
  EXPECT_FALSE(after(seconds(6), 6, &large));
  EXPECT_TRUE(after(seconds(7), 6, &large));
}

TEST(Limits, MemoryMayGoAQuarterAndAGraceBeyondWhatWasGranted) {
  Limits const limits{800'000'000, 0};
  EXPECT_FALSE(limits.swells(1'000'000'000 + (256u << 20)));
  ASSERT_TRUE(limits.swells(1'000'000'001 + (256u << 20)));
  EXPECT_THAT(limits.swells(2'000'000'000)->reason, HasSubstr("2000 MB, and --memory allows 800"));
}

TEST(Limits, SilenceIsBorneForTenMinutes) {
  EXPECT_FALSE(silent(seconds(600)));
  EXPECT_TRUE(silent(seconds(601)));
}

}  // namespace
}  // namespace vitrine::graph
