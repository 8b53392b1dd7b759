// SPDX-License-Identifier: Apache-2.0
#include "io/csv.h"

#include "stages/error.h"

#include <algorithm>
#include <utility>

namespace vitrine::io {
namespace {

class CsvParser {
 public:
  explicit CsvParser(std::string_view text) : rest_(text) {}

  std::vector<CsvRow> parse() {
    std::vector<CsvRow> rows;
    while (!rest_.empty()) {
      CsvRow row = parse_row();
      bool const blank = row.cells.size() == 1 && row.cells[0].empty();
      if (!blank) rows.push_back(std::move(row));
    }
    return rows;
  }

 private:
  CsvRow parse_row() {
    CsvRow row{line_, {}};
    do row.cells.push_back(rest_.starts_with('"') ? quoted() : plain());
    while (take(","));
    if (!take("\r\n") && !take("\n") && !rest_.empty()) fail("text after a closing quote");
    ++line_;
    return row;
  }

  bool take(std::string_view expected) {
    if (!rest_.starts_with(expected)) return false;
    rest_.remove_prefix(expected.size());
    return true;
  }

  std::string plain() {
    std::size_t const end = std::min(rest_.find_first_of(",\n"), rest_.size());
    std::string cell(rest_.substr(0, end));
    rest_.remove_prefix(end);
    if (cell.ends_with('\r')) cell.pop_back();
    return cell;
  }

  std::string quoted() {
    std::string cell;
    for (std::size_t at = 1;;) {
      std::size_t const end = rest_.find('"', at);
      if (end == std::string_view::npos) fail("a quote is not closed");
      cell += rest_.substr(at, end - at);
      at = end + 1;
      if (!rest_.substr(at).starts_with('"')) {
        rest_.remove_prefix(at);
        break;
      }
      cell += '"';
      ++at;
    }
    line_ += static_cast<std::uint64_t>(std::count(cell.begin(), cell.end(), '\n'));
    return cell;
  }

  [[noreturn]] void fail(std::string const& what) const {
    throw Error(ErrorKind::invalid_input, "line " + std::to_string(line_) + ": " + what,
                "quote cells that hold commas or quotes, and write a quote inside as two");
  }

  std::string_view rest_;
  std::uint64_t line_ = 1;
};

}  // namespace

std::vector<CsvRow> parse_csv(std::string_view text) { return CsvParser(text).parse(); }

std::string csv_cell(std::string text) {
  if (!text.empty() && std::string_view("=+-@\t\r").find(text[0]) != std::string_view::npos) text.insert(0, "'");
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

}  // namespace vitrine::io
