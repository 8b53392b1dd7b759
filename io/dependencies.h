// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Which bytes a model is made of: what tells whether it has changed.

#include "io/blob.h"

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>

namespace vitrine::io {

/// XXH3 of 128 bits, as 32 hexadecimal digits.
std::string content_hash(std::span<std::byte const> bytes);
std::string content_hash(std::string_view text);

/// The same of a file, which is read and not mapped: one that shrinks meanwhile does no harm. "" when it cannot be
/// read.
std::string file_hash(std::filesystem::path const& file);

/// By the name that a model uses: the hash of the file that was found, "" where none was.
using Dependencies = std::map<std::string, std::string>;

/// `resolve`, noting in `found` what it is asked for, also what it refuses. `found` must outlive the result; one call
/// at a time.
Resolve recording(Resolve resolve, Dependencies& found);

/// What the file system says of a file. As long as it says the same, the bytes are taken to be the same: the time of
/// the last change (ctime) moves with every write and rename, and no program can set it back.
struct Stamp {
  std::uint64_t bytes = 0, inode = 0;
  std::int64_t modified = 0, changed = 0;  ///< nanoseconds since 1970
  bool operator==(Stamp const&) const = default;
};

/// Nothing when there is no such file.
std::optional<Stamp> stamp(std::filesystem::path const& file);

/// Whether the stamp tells of bytes that were read at `moment` or later: two seconds, the coarsest clock of a file
/// system, lie between the last change and the reading.
bool settled(Stamp const& stamp, std::chrono::system_clock::time_point moment);

}  // namespace vitrine::io
