// SPDX-License-Identifier: Apache-2.0
#include "graph/death.h"

#include <gmock/gmock.h>

#include <csignal>

namespace vitrine::graph {
namespace {

using testing::HasSubstr;

constexpr int kExited3 = 3 << 8;  // as waitpid tells it; a signal's number is its own

TEST(Death, OfACrashIsTheModels) {
  Conviction const found = convict({SIGSEGV, {}}, "bake", "last words\n");
  EXPECT_EQ(found.status, "quarantined");
  EXPECT_EQ(found.failure.stage, "bake");
  EXPECT_THAT(found.failure.reason, HasSubstr("SIGSEGV"));
  EXPECT_THAT(found.failure.remedy, HasSubstr("retry --quarantined"));
  EXPECT_EQ(found.failure.cause, Cause::model);
  EXPECT_EQ(found.evidence, "last words\n");
}

TEST(Death, InTheMiddleOfTheWorkIsACrashHoweverItLeaves) {
  EXPECT_THAT(convict({kExited3, {}}, "load", "").failure.reason, HasSubstr("exit code 3"));
}

TEST(Death, ByTheGuardsHandIsForTheGuardsReason) {
  Death const death{SIGKILL, Sentence{"no progress in 6 s", "wait longer"}};
  EXPECT_FALSE(death.by_a_stranger());
  EXPECT_EQ(death.how(), "no progress in 6 s");
  EXPECT_THAT(convict(death, "load", "").failure.remedy, HasSubstr("wait longer; vitrine retry"));
}

TEST(Death, ByAnotherHandIsAStrangers) {
  EXPECT_TRUE((Death{SIGKILL, {}}.by_a_stranger()));
  EXPECT_FALSE((Death{SIGTERM, {}}.by_a_stranger()));
}

TEST(Death, OfAFileThatCannotBeReadLiesInTheMachine) {
  Conviction const found = convict({SIGBUS, {}}, "load", "");
  EXPECT_EQ(found.status, "failed");
  EXPECT_EQ(found.failure.cause, Cause::machine);
}

}  // namespace
}  // namespace vitrine::graph
