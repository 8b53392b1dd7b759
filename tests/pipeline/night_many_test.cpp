// SPDX-License-Identifier: Apache-2.0
// A thousand models in one run: memory stays at what the first hundred took.
#include "tests/support/night.h"

#include <algorithm>
#include <utility>

namespace vitrine {
namespace {

using test::Night;

/// A worker's memory over its run and the ends of its models, as --trace tells: microseconds and MB.
struct Course {
  std::vector<std::pair<double, double>> memory;
  std::vector<double> ends;  ///< ascending
};

Course course(std::string const& trace) {
  Course found;
  nlohmann::json const told = nlohmann::json::parse(test::read_file(trace));
  for (auto const& event : told["traceEvents"]) {
    std::string const name = event["name"];
    if (name == "memory used") found.memory.emplace_back(event["ts"], event["args"].begin().value());
    if (name.ends_with(".obj")) found.ends.push_back(double(event["ts"]) + double(event["dur"]));
  }
  std::sort(found.ends.begin(), found.ends.end());
  return found;
}

double largest(Course const& all, double begin, double end) {
  double most = 0;
  for (auto const& [at, used] : all.memory)
    if (begin <= at && at <= end) most = std::max(most, used);
  return most;
}

TEST_F(Night, MemoryStaysWhereItIsAfterTheFirstModels) {
  constexpr int kCount = 1000, kFirst = 100;
  add_good(kCount);
  ASSERT_EQ(run(convert("g", {"--trace", at("trace.json"), "--no-certificate"})).code, 0);
  Course const all = course(at("trace.json"));
  ASSERT_EQ(all.ends.size(), std::size_t(kCount)) << "a worker's trace holds each of its models";
  double const then = largest(all, 0, all.ends[kFirst]), now = largest(all, all.ends[kCount - kFirst], all.ends.back());
  EXPECT_LT(now, 1.05 * then) << "MB after " << kCount << " models, against " << then << " after " << kFirst;
  RecordProperty("MB", std::to_string(then) + " " + std::to_string(now));
}

}  // namespace
}  // namespace vitrine
