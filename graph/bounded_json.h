// SPDX-License-Identifier: Apache-2.0
#pragma once
/// JSON from others: the library reads and copies nested values by recursion, so what is nested deeper than anything of
/// ours could end this process.

#include "graph/strict_json.h"

#include <optional>
#include <string_view>

namespace vitrine::graph {

/// Of CBOR. Nothing when these bytes are not one value, or one that is nested deeper than 64 levels.
std::optional<StrictJson> bounded_cbor(std::string_view bytes);

/// Of text. Nothing likewise.
std::optional<StrictOrderedJson> bounded_json(std::string_view text);

}  // namespace vitrine::graph
