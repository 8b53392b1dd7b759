// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How a worker died, and what becomes of the model that took it down.

#include "graph/limits.h"
#include "graph/options.h"
#include "graph/record.h"

#include <optional>
#include <string>

namespace vitrine::graph {

struct Death {
  int status = 0;                    ///< as waitpid tells it
  std::optional<Sentence> sentence;  ///< where the guard ended it

  std::string how() const;
  /// By a signal that neither worker nor guard had a reason for: the machine's memory killer, an operator.
  bool by_a_stranger() const;
  /// Files are mapped: where one cannot be read, whoever looks at it gets SIGBUS.
  bool by_an_unreadable_file() const;
};

/// A model that took its worker down.
struct Conviction {
  std::string status;
  Failure failure;
  std::string evidence;
};

/// stage: where the model was; evidence: the last lines of the log.
Conviction convict(Death const& death, std::string const& stage, std::string const& evidence);

/// Opens the model's file to hash it, and nothing else of it.
Record record_of(Conviction const& conviction, io::ArchiveEntry const& entry, ModelOptions const& options);

}  // namespace vitrine::graph
