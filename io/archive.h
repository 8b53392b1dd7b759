// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What lies below a folder of scans.

#include "io/blob.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace vitrine::io {

enum class UpAxis { y, z };

/// What a model will take, guessed from headers before anything is read whole.
struct Estimate {
  std::uint64_t triangles = 0;
  std::uint64_t memory = 0;   ///< bytes at the peak of the pipeline
  std::uint64_t thinned = 0;  ///< the same where it is clustered first; 0: it may have textures, and is not
};

/// One model of the archive.
struct ArchiveEntry {
  std::string path;            ///< relative to the archive's root, '/' between folders, as the file system spells it
  std::filesystem::path file;  ///< where it is
  std::uint64_t bytes = 0;     ///< of the model's own file
  std::string slug;            ///< from the path: [a-z0-9-], at most 60; then '-' and 8 hex digits of the path's xxHash
  UpAxis up = UpAxis::y;
  std::map<std::string, std::string> metadata;  ///< archive.csv's further columns: title, credit, licence, link, …
  Estimate estimate{};
};

struct ArchiveOptions {
  UpAxis up = UpAxis::y;                      ///< of models for which archive.csv says nothing
  std::vector<std::string> include, exclude;  ///< globs over relative paths; `*` stays within a folder, `**` does not
};

struct Archive {
  std::vector<ArchiveEntry> entries;  ///< sorted by path, bytewise
  std::vector<std::string>
      notes;  ///< rows of archive.csv without a file, unreadable folders, special files passed over
};

/// Walks the folder. Symbolic links that leave it, and special files (FIFO, socket, device), are passed over with a
/// note. archive.csv (RFC 4180, UTF-8, a header row with at least `path`) at the root gives metadata and up axes.
/// `opening` hears of each entry before its header is read, and says whether to.
/// Errors: InvalidInput when root is no folder, or archive.csv is malformed (with its line).
Archive read_archive(std::filesystem::path const& root, ArchiveOptions const& options = {},
                     std::function<bool(ArchiveEntry const&)> const& opening = {});

/// Reads headers only; a damaged file is judged by its size.
Estimate estimate(ArchiveEntry const& entry);

}  // namespace vitrine::io
