// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Bytes of a file, and how a model finds the files that it names.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vitrine::io {

/// Read-only bytes that stay valid as long as a copy of the blob lives.
struct Blob {
  std::span<std::byte const> bytes;
  std::shared_ptr<void const> owner;
};

Blob own(std::vector<std::byte> bytes);
std::string_view characters(std::span<std::byte const> bytes);
/// Without the mark that some editors put in front of UTF-8.
std::string_view without_mark(std::string_view text);
/// A blob's characters, without that mark.
std::string_view text(Blob const& blob);

/// A memory map of the file, to be read once from front to back.
/// Errors: InvalidInput when it cannot be opened or is no regular file; std::filesystem::filesystem_error when its disk
///         fails
/// (if that happens later, whoever reads the map gets SIGBUS). Empty files give an empty blob.
Blob map_file(std::filesystem::path const& path);

/// Finds what a model names (mtllib, map_*, uri). Nothing when there is no such file.
/// Errors: InvalidInput for a name that leads out of the model's folder (absolute, "..", symbolic link, URL).
using Resolve = std::function<std::optional<Blob>(std::string_view reference)>;

/// Where a reference leads, as resolve_in finds it; nothing when there is no such file. Errors: as Resolve.
std::optional<std::filesystem::path> find_in(std::filesystem::path const& folder, std::string_view reference);

/// Resolves in one folder: backslashes are slashes, %20-escapes are tried literally first, then decoded; a name in
/// another case is taken where it is the only one.
Resolve resolve_in(std::filesystem::path const& folder);

}  // namespace vitrine::io
