// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Files that are whole or not there: written aside, flushed to disk, renamed.

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

namespace vitrine::io {

/// Replaces `path` atomically; makes its folder. A reader sees the old file or the new one, also after a crash.
/// Errors: std::filesystem::filesystem_error with the path and the system's reason (disk full, not permitted).
void publish_file(std::filesystem::path const& path, std::span<std::byte const> bytes);
void publish_file(std::filesystem::path const& path, std::string_view text);

/// Removes what an interrupted run left aside below `folder`.
void sweep_unfinished(std::filesystem::path const& folder);

}  // namespace vitrine::io
