// SPDX-License-Identifier: Apache-2.0
#include "tools/report/page_table.h"

#include "tools/report/paper_tables.h"

#include <fmt/format.h>

namespace vitrine::report {
namespace {

constexpr double kMegabits[] = {1.6, 10, 50};  ///< a second: slow 3G, a phone, a line at home

/// `code`: loaded once; `all`: bytes of `objects` objects.
std::vector<Cell> row(std::string name, double code, double all, double objects) {
  std::vector<Cell> cells{Cell(std::move(name))};
  double const loads[] = {code + all / objects, code + all};
  for (double bytes : loads) cells.push_back(Cell(bytes / 1000, 1));
  for (double bytes : loads)
    for (double megabits : kMegabits) cells.push_back(Cell(8 * bytes / (1e6 * megabits), 2));
  return cells;
}

}  // namespace

Table page_table(Gallery const& gallery) {
  Json const& page = gallery.page;
  double const objects = page.value("objects", 0.0);
  Table table{"page", fmt::format("A page of all {} objects", objects), {"objects as", "first, KB", "all, KB"}, {}};
  for (char const* which : {"first", "all"})
    for (double megabits : kMegabits) table.columns.push_back(fmt::format("{}, s at {} Mbit/s", which, megabits));
  if (!(objects > 0) || !page.contains("viewer") || !page.contains("decoder")) return table;
  double const viewer = page["viewer"].value("gzip", 0.0), decoder = page["decoder"].value("gzip", 0.0);
  if (page.contains("plain"))
    table.rows.push_back(row("3D, with viewer", viewer, page["plain"].value("thumbnails", 0.0), objects));
  else
    table.rows.push_back(row("3D, with viewer and decoder", viewer + decoder, page.value("thumbnails", 0.0), objects));
  Json const series = page.value("series", Json::object());
  for (auto const& [codec, sizes] : series.items())
    for (auto const& [frames, bytes] : sizes.items())
      table.rows.push_back(row(frames + " pictures, " + codec_name(codec), 0, bytes, objects));
  return table;
}

}  // namespace vitrine::report
