// SPDX-License-Identifier: Apache-2.0
#include "tools/report/table.h"

#include "io/csv.h"
#include "tools/report/escape.h"

#include <fmt/format.h>

namespace vitrine::report {
namespace {

std::string grouped(std::string number) {
  std::size_t const point = std::min(number.find('.'), number.size()), first = number.starts_with('-') ? 1 : 0;
  for (std::size_t at = point; at > first + 3; at -= 3) number.insert(at - 3, ",");
  return number;
}

std::string plain(Cell const& cell) {
  return cell.number ? fmt::format("{:.{}f}", *cell.number, cell.digits) : cell.text;
}

bool numeric(Table const& table, std::size_t column) {
  for (auto const& row : table.rows)
    if (row[column].number) return true;
  return false;
}

std::string html_row(Table const& table, std::vector<Cell> const& row) {
  std::string out = "<tr>";
  for (std::size_t c = 0; c < row.size(); ++c)
    out += c == 0 ? "<th scope=\"row\"><bdi>" + html(shown(row[c])) + "</bdi></th>"
                  : (numeric(table, c) ? "<td class=\"number\">" : "<td>") + html(shown(row[c])) + "</td>";
  return out + "</tr>\n";
}

}  // namespace

std::string shown(Cell const& cell) {
  if (cell.number) return grouped(plain(cell));
  return cell.text.empty() ? "\xE2\x80\x93" : cell.text;
}

std::string to_html(Table const& table) {
  std::string out = "<div class=\"table\" role=\"region\" tabindex=\"0\" aria-label=\"" + html(table.caption) +
                    "\"><table>\n<caption>" + html(table.caption) + "</caption>\n<thead><tr>";
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    out += std::string("<th scope=\"col\"") + (numeric(table, c) ? " class=\"number\">" : ">") +
           html(table.columns[c]) + "</th>";
  out += "</tr></thead>\n<tbody>\n";
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    if (r + table.summary_rows == table.rows.size()) out += "</tbody>\n<tbody class=\"summary\">\n";
    out += html_row(table, table.rows[r]);
  }
  return out + "</tbody></table></div>\n";
}

std::string to_markdown(Table const& table) {
  std::string out = markdown(table.caption) + "\n\n|", rule = "\n|";
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    out += " " + markdown(table.columns[c]) + " |";
    rule += numeric(table, c) ? "---:|" : "---|";
  }
  out += rule + "\n";
  for (auto const& row : table.rows) {
    out += "|";
    for (Cell const& cell : row) out += " " + markdown(shown(cell)) + " |";
    out += "\n";
  }
  return out;
}

std::string to_csv(Table const& table) {
  std::string out;
  for (std::size_t c = 0; c < table.columns.size(); ++c) out += (c ? "," : "") + io::csv_cell(table.columns[c]);
  out += "\r\n";
  for (auto const& row : table.rows) {
    for (std::size_t c = 0; c < row.size(); ++c)
      out += (c ? "," : "") + (row[c].number ? plain(row[c]) : io::csv_cell(row[c].text));
    out += "\r\n";
  }
  return out;
}

}  // namespace vitrine::report
