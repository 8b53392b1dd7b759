// SPDX-License-Identifier: Apache-2.0
// A thousand models in one run: memory returns to its base after each. With VITRINE_NIGHT=full all of the thousand.
#include "tests/support/night.h"

#include <algorithm>

namespace vitrine {
namespace {

using test::Night;
using test::times;

/// Bytes that the worker had in memory, over its run, as --trace tells.
std::vector<double> memory_used(std::string const& trace) {
  std::vector<double> used;
  nlohmann::json const told = nlohmann::json::parse(test::read_file(trace));
  for (auto const& event : told["traceEvents"])
    if (event["name"] == "memory used") used.push_back(event["args"].begin().value());
  return used;
}

double largest(std::vector<double> const& all, std::size_t begin, std::size_t end) {
  return *std::max_element(all.begin() + std::ptrdiff_t(begin), all.begin() + std::ptrdiff_t(end));
}

TEST_F(Night, MemoryStaysWhereItIsAfterTheFirstModels) {
  int const count = times(120, 1000), first = times(60, 100);
  add_good(count);
  ASSERT_EQ(run(convert("g", {"--trace", at("trace.json"), "--no-certificate"})).code, 0);
  std::vector<double> const used = memory_used(at("trace.json"));
  ASSERT_GE(used.size(), std::size_t(count)) << "a worker's trace holds each of its models";
  std::size_t const each = used.size() / std::size_t(count), some = 20 * each;
  double const then = largest(used, each * std::size_t(first) - some, each * std::size_t(first));
  double const now = largest(used, used.size() - some, used.size());
  EXPECT_LT(now, 1.05 * then) << "MB after " << count << " models, against " << then << " after " << first;
  RecordProperty("MB", std::to_string(then) + " " + std::to_string(now));
}

}  // namespace
}  // namespace vitrine
