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
  if (!(objects > 0) || !page.contains("viewer")) return table;
  bool const plain = page.contains("plain"), decodes = !plain && page.contains("decoder");
  double const code = page["viewer"].value("gzip", 0.0) + (decodes ? page["decoder"].value("gzip", 0.0) : 0);
  double const thumbnails = (plain ? page["plain"] : page).value("thumbnails", 0.0);
  table.rows.push_back(row(decodes ? "3D, with viewer and decoder" : "3D, with viewer", code, thumbnails, objects));
  Json const series = page.value("series", Json::object());
  for (auto const& [codec, sizes] : series.items())
    for (auto const& [frames, bytes] : sizes.items())
      table.rows.push_back(row(frames + " pictures, " + codec_name(codec), 0, bytes, objects));
  return table;
}

Table wait_table(Gallery const& gallery) {
  Json const measured = gallery.page.value("measured", Json::object());
  Table table{
      "page-measured",
      fmt::format("Waited for, in seconds; decoding one object took {:.0f} ms", measured.value("decoding", 0.0)),
      {"objects as", "Mbit/s", "latency, ms", "first poster", "first object", "loaded by then, KB", "all in view",
       "loaded by then, KB"},
      {}};
  for (Json const& visit : measured.value("visits", Json::array())) {
    std::vector<Cell> cells{Cell(visit.at("view") == "3d" ? "3D" : "pictures, one axis"),
                            Cell(visit.at("megabits").get<double>(), 1), Cell(visit.at("latency").get<double>(), 0),
                            Cell(visit.at("poster").get<double>(), 1)};
    for (char const* when : {"first", "all"}) {
      cells.push_back(Cell(visit.at(when).get<double>(), 1));
      cells.push_back(Cell(visit.at("bytes").at(when).get<double>() / 1000, 0));
    }
    table.rows.push_back(std::move(cells));
  }
  return table;
}

}  // namespace vitrine::report
