// SPDX-License-Identifier: Apache-2.0
#include "io/first_use.h"

#include <gmock/gmock.h>

#include <array>
#include <map>
#include <random>

namespace vitrine {
namespace {

using io::FirstUse;
using testing::ElementsAre;
using Key = std::array<std::uint32_t, 3>;

std::vector<Key> random_keys(std::size_t count, std::uint32_t distinct) {
  std::mt19937 random(1);
  std::vector<Key> keys(count);
  for (Key& key : keys) key = {std::uint32_t(random()) % distinct, 0, std::uint32_t(random()) % 2};
  return keys;
}

TEST(FirstUse, CountsUpWithEachNewKey) {
  FirstUse<Key> keys;
  EXPECT_EQ(keys.number({5, 0, 0}), 0u);
  EXPECT_EQ(keys.number({3, 0, 0}), 1u);
  EXPECT_EQ(keys.number({5, 0, 0}), 0u);
  EXPECT_THAT(keys.keys(), ElementsAre(Key{5, 0, 0}, Key{3, 0, 0}));
}

TEST(FirstUse, AgreesWithAMapWhileItGrows) {
  FirstUse<Key> keys;
  std::map<Key, std::uint32_t> expected;
  for (Key const& key : random_keys(20000, 3000)) {
    auto const next = static_cast<std::uint32_t>(expected.size());
    ASSERT_EQ(keys.number(key), expected.try_emplace(key, next).first->second);
  }
  EXPECT_EQ(keys.keys().size(), expected.size());
}

TEST(FirstUse, ManyAtOnceAreNumberedAsOneByOne) {
  std::vector<Key> const input = random_keys(1000, 200);
  FirstUse<Key> one_by_one, at_once;
  std::vector<std::uint32_t> expected, numbers(input.size());
  for (Key const& key : input) expected.push_back(one_by_one.number(key));
  at_once.number(input, numbers);
  EXPECT_EQ(numbers, expected);
}

}  // namespace
}  // namespace vitrine
