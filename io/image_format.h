// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Which format an image is in: by content, since archives misname their textures. Internal to io.

#include <cstddef>
#include <span>
#include <string>

namespace vitrine::io {

/// The name of OpenImageIO's reader, "webp" or "avif". Formats that it reads from files only, or by way of much code
/// that has seen little hostile input, are left out. Errors: Unsupported for those, by their names; InvalidInput for
/// what is no image.
std::string image_format(std::span<std::byte const> bytes);

}  // namespace vitrine::io
