// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Files that are whole or not there: written aside, flushed to disk, renamed.

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>
#include <system_error>

namespace vitrine::io {

/// Replaces `path` atomically; makes its folder. A reader sees the old file or the new one, also after a crash. Any
/// number of threads and processes may publish at once; of several to one path the last one wins.
/// Errors: std::filesystem::filesystem_error with the path and the system's reason (disk full, not permitted).
void publish_file(std::filesystem::path const& path, std::span<std::byte const> bytes);
void publish_file(std::filesystem::path const& path, std::string_view text);

/// Whether the disk, or this user's share of it, is full.
bool is_full(std::error_code const& error);

/// Removes a file for good, if it is there: on return no crash brings it back. Errors: as publish_file.
void withdraw_file(std::filesystem::path const& path);

/// Removes what an interrupted run left aside below `folder`; call it while nothing is being published there.
void sweep_unfinished(std::filesystem::path const& folder);

}  // namespace vitrine::io
