// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The same originals, converted again at other settings.

#include "io/archive.h"
#include "tools/report/study.h"

namespace vitrine::report {

/// The gallery's originals in its archive, in the gallery's order, with the up axes that they were converted with.
/// Errors: those of read_archive; InvalidInput, naming it, when one is gone.
io::Archive originals(Gallery const& gallery);

/// Converts into GALLERY/.vitrine/report/SETTING/, a gallery of its own kind. What an earlier run left there from the
/// same input, by the same options and program, is kept. A model that fails is told on stderr and leaves a gap.
/// Out: one trial for each setting. Progress on stderr.
std::vector<Trial> run_trials(Gallery const& gallery, io::Archive const& archive, std::vector<Setting> const& settings,
                              graph::RunOptions const& machine);

}  // namespace vitrine::report
