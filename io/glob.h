// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Patterns of paths. Internal to io.

#include <string_view>

namespace vitrine::io {

/// `*` and `?` stay within a folder, `**` does not; "**/" also stands for no folder at all. The whole path must match.
bool matches_glob(std::string_view pattern, std::string_view path);

}  // namespace vitrine::io
