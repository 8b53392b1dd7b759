// SPDX-License-Identifier: Apache-2.0
#include "io/ledger.h"

#include "tests/support/folders.h"

#include <gmock/gmock.h>

namespace vitrine::io {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;

class LedgerFile : public testing::Test {
 protected:
  test::TemporaryFolder folder_;
  std::filesystem::path const file_ = folder_.path() / "new/ledger.sqlite";
};

TEST_F(LedgerFile, KeepsAnyBytesBetweenRuns) {
  std::string const bytes("\0\xff'; DROP TABLE models", 23);
  {
    Ledger ledger(file_);
    EXPECT_TRUE(ledger.begun_anew());
    ledger.put("a", "first");
    ledger.put("a", bytes);
    ledger.put("b", "");
    ledger.put("c", "c");
    ledger.erase("c");
    EXPECT_THAT(read_ledger(file_), ElementsAre(Pair("a", bytes), Pair("b", ""))) << "while it is being written";
  }
  Ledger const again(file_);
  EXPECT_FALSE(again.begun_anew());
  EXPECT_THAT(again.entries(), ElementsAre(Pair("a", bytes), Pair("b", "")));
}

TEST_F(LedgerFile, IsBegunAnewWhenItIsNoLedger) {
  test::write_file(file_, std::string(10000, 'x'));
  EXPECT_THAT(read_ledger(file_), IsEmpty());
  Ledger ledger(file_);
  EXPECT_TRUE(ledger.begun_anew());
  ledger.put("a", "a");
  EXPECT_THAT(ledger.entries(), ElementsAre(Pair("a", "a")));
}

TEST_F(LedgerFile, LeavesOutWhatIsDamaged) {
  {
    Ledger ledger(file_);
    ledger.put("a", std::string(100, 'a'));
    ledger.put("b", std::string(100, 'b'));
  }
  std::string const bytes = test::read_file(file_);
  std::size_t const slug = bytes.find("aaaaaaaa");  // its bytes and its slug's are the same letter
  for (std::size_t const at : {slug, slug + 50}) {
    std::string damaged = bytes;
    damaged[at] = 'A';
    test::write_file(file_, damaged);
    EXPECT_THAT(Ledger(file_).entries(), ElementsAre(Pair("b", std::string(100, 'b')))) << at - slug;
  }
}

TEST_F(LedgerFile, NothingIsReadWhereNoneIs) {
  EXPECT_THAT(read_ledger(file_), IsEmpty());
  EXPECT_FALSE(std::filesystem::exists(file_));
}

}  // namespace
}  // namespace vitrine::io
