// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Which codecs this program runs with: another version of a library may write other bytes.

#include <string>

namespace vitrine::io {

/// "avif 0.11.1 (aom …), webp 1.2.4, …": those that are linked, not those of the headers, where they tell.
std::string codec_versions();

}  // namespace vitrine::io
