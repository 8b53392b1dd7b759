// SPDX-License-Identifier: Apache-2.0
// docs/options.md says what the option structs say. To bless a change: VITRINE_BLESS=1 ctest -R golden
#include "tests/support/folders.h"
#include "tools/options_page.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace vitrine {
namespace {

TEST(OptionsPage, IsWhatTheStructsSay) {
  std::filesystem::path const page = std::filesystem::path(VITRINE_SOURCE_DIR) / "docs/options.md";
  if (std::getenv("VITRINE_BLESS")) test::write_file(page, tools::options_page());
  EXPECT_EQ(test::read_file(page), tools::options_page());
}

}  // namespace
}  // namespace vitrine
