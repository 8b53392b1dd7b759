// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What archives hold in place of a file. Internal to io.

#include <cstddef>
#include <span>
#include <string_view>

namespace vitrine::io {

/// `what` ("file", "image") names it in errors.
/// Errors: InvalidInput for a pointer of Git-LFS, a web page that a failed download left, text of two bytes a character.
void refuse_stand_in(std::span<std::byte const> bytes, std::string_view what);

}  // namespace vitrine::io
