// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Which bytes a model is made of: what tells whether it has changed.

#include "io/blob.h"

#include <map>
#include <span>
#include <string>

namespace vitrine::io {

/// XXH3 of 128 bits, as 32 hexadecimal digits.
std::string content_hash(std::span<std::byte const> bytes);

/// By the name that a model uses: the hash of the file that was found, "" where none was.
using Dependencies = std::map<std::string, std::string>;

/// `resolve`, noting in `found` what it is asked for. `found` must outlive the result; one call at a time.
Resolve recording(Resolve resolve, Dependencies& found);

}  // namespace vitrine::io
