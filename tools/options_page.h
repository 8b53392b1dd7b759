// SPDX-License-Identifier: Apache-2.0
#pragma once
/// docs/options.md, written from the options structs.

#include <string>

namespace vitrine::tools {

/// The page as Markdown: a table per group of options.
std::string options_page();

}  // namespace vitrine::tools
