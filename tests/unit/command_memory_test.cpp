// SPDX-License-Identifier: Apache-2.0
#include "tools/command_memory.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <ctime>

namespace vitrine::tools {
namespace {

using std::chrono::system_clock;

/// In UTC.
class StopAt : public testing::Test {
 protected:
  StopAt() {
    ::setenv("TZ", "UTC", 1);
    ::tzset();
  }
  static constexpr std::time_t kSixInTheEvening = 1'700'000'000 / 86400 * 86400 + 18 * 3600;
  static long hours(std::string const& time) {
    return long(system_clock::to_time_t(next_time(time, kSixInTheEvening)) - kSixInTheEvening) / 3600;
  }
};

TEST_F(StopAt, IsTheNextTimeThatTheClockShows) {
  EXPECT_EQ(hours("19:00"), 1);
  EXPECT_EQ(hours("07:00"), 13);
  EXPECT_EQ(hours("18:00"), 24) << "not now";
  EXPECT_EQ(hours("00:00"), 6);
}

TEST_F(StopAt, OnlyTimesOfDayAreTaken) {
  EXPECT_EQ(check_time("07:00"), "");
  for (char const* wrong : {"7:00", "24:00", "12:60", "07:00 ", "-1:00", "now", ""})
    EXPECT_THAT(check_time(wrong), testing::HasSubstr("no time of day like 07:00")) << wrong;
}

}  // namespace
}  // namespace vitrine::tools
