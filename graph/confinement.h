// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The process that opens models can do little else: read the archive, write the gallery, use memory up to a limit.

#include <cstdint>
#include <filesystem>
#include <string>

namespace vitrine::graph {

struct Confinement {
  std::string level;    ///< what is in force: "limits, no-new-privs, landlock 3, seccomp"
  std::string missing;  ///< what this kernel refuses; empty: nothing
};

/// Confines this process for good; call it before any thread is started.
/// - limits: no core files; writable memory up to twice `memory` and 2 GB, so that a huge allocation fails at once
/// - Landlock: only the gallery can be written; only the archive, the gallery, the program and the system's own folders
///   be read
/// - seccomp: no process can be started, no socket opened, nothing traced, mounted or loaded
/// `more`: another folder that can be written; empty: none.
Confinement confine(std::filesystem::path const& archive, std::filesystem::path const& gallery, std::uint64_t memory,
                    std::filesystem::path const& more = {});

}  // namespace vitrine::graph
