// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Names of models are data: what stands in a page, a table or a chart is escaped for it here.

#include <cstddef>
#include <string>
#include <string_view>

namespace vitrine::report {

/// For the text and the attributes of HTML and XML: &, <, >, quotes. Control characters, which XML has no place for,
/// become U+FFFD.
std::string html(std::string_view text);

/// For a cell of a Markdown table: marks get a backslash, line ends and other control characters become spaces.
std::string markdown(std::string_view text);

/// The first `characters` of UTF-8 text, the last of them an ellipsis where something is cut.
std::string shortened(std::string_view text, std::size_t characters);

}  // namespace vitrine::report
