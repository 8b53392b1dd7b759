// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The summary of a night, for people.

#include "graph/summary.h"

#include <string>
#include <vector>

namespace vitrine::tools {

/// For the screen: names that hold control characters are made printable.
std::string summary_text(graph::Summary const& summary, std::string const& gallery);

/// report.html: one page without scripts or other files, light or dark as the reader's system is; every name escaped.
std::string summary_html(graph::Summary const& summary, std::vector<graph::ModelRow> const& rows);

}  // namespace vitrine::tools
