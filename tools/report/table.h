// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A table as HTML, CSV and Markdown.

#include <optional>
#include <string>
#include <vector>

namespace vitrine::report {

/// Text, a number of so many decimals, or nothing.
struct Cell {
  Cell() = default;
  Cell(std::string words) : text(std::move(words)) {}
  Cell(double value, int decimals) : number(value), digits(decimals) {}
  Cell(std::optional<double> value, int decimals) : number(value), digits(decimals) {}

  std::optional<double> number;
  int digits = 0;
  std::string text;
};

struct Table {
  std::string name;     ///< of its files: "table3"
  std::string caption;  ///< plain text
  std::vector<std::string> columns;
  std::vector<std::vector<Cell>> rows;
  std::size_t summary_rows = 0;  ///< at the end: means and the like, set apart
};

/// "1,234.5"; a dash for nothing.
std::string shown(Cell const& cell);

std::string to_html(Table const& table);
std::string to_markdown(Table const& table);
/// RFC 4180, numbers plain. Text that a spreadsheet would take for a formula starts with an apostrophe.
std::string to_csv(Table const& table);

}  // namespace vitrine::report
