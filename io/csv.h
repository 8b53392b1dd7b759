// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Comma-separated values.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace vitrine::io {

struct CsvRow {
  std::uint64_t line = 0;  ///< where it begins, from 1
  std::vector<std::string> cells;
};

/// Rows that hold something. Cells may be quoted, and quoted ones hold commas, line ends and "" for a quote; a byte
/// order mark is skipped. Source: RFC 4180. Errors: InvalidInput, with the line, for a quote that is not closed or
/// closed early.
std::vector<CsvRow> parse_csv(std::string_view text);

/// A cell as it stands in a file: quoted where needed; an apostrophe before what a spreadsheet would take for a
/// formula.
std::string csv_cell(std::string text);

}  // namespace vitrine::io
