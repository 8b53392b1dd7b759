// SPDX-License-Identifier: Apache-2.0
#include "graph/death.h"

#include "graph/arrival.h"
#include "graph/child.h"
#include "graph/settings.h"
#include "io/dependencies.h"

#include <sys/wait.h>

#include <csignal>

namespace vitrine::graph {
namespace {

bool killed_by(Death const& death, int signal) {
  return !death.sentence && WIFSIGNALED(death.status) && WTERMSIG(death.status) == signal;
}

}  // namespace

std::string Death::how() const { return sentence ? sentence->reason : describe_status(status); }
bool Death::by_a_stranger() const { return killed_by(*this, SIGKILL); }
bool Death::by_an_unreadable_file() const { return killed_by(*this, SIGBUS); }

Conviction convict(Death const& death, std::string const& stage, std::string const& evidence) {
  if (death.by_an_unreadable_file())
    return {"failed",
            {stage, "a file of it could not be read to its end: its disk failed, or it was cut off meanwhile",
             "check the archive's disk; the next run tries it again", Cause::machine},
            evidence};
  std::string const remedy = death.sentence ? death.sentence->remedy : "please report this model as a bug";
  return {"quarantined", {stage, death.how(), remedy + "; vitrine retry --quarantined tries it again"}, evidence};
}

Record record_of(Conviction const& conviction, io::ArchiveEntry const& entry, ModelOptions const& options) {
  Record record{
      arriving(entry, options.cluster), settings_hash(options, title_of(entry), entry.up), {}, 0, conviction.evidence};
  record.row.status = conviction.status;
  record.row.failure = conviction.failure;
  record.row.input_hash = io::file_hash(entry.file);
  return record;
}

}  // namespace vitrine::graph
