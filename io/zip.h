// SPDX-License-Identifier: Apache-2.0
#pragma once
/// ZIP archives in memory.

#include "stages/data.h"

#include <cstddef>
#include <span>
#include <vector>

namespace vitrine::io {

/// The files, deflated, in this order, all dated 1980-01-01: the same bytes for the same files, at any time and place.
/// Errors: Broken when libzip refuses, as it does two files of one name.
std::vector<std::byte> zip(std::span<NamedFile const> files);

}  // namespace vitrine::io
