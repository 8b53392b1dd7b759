// SPDX-License-Identifier: Apache-2.0
#include "tools/report/paper_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace vitrine::report {
namespace {

constexpr int kFrames[] = {8, 16, 32};

double kilobytes(std::size_t bytes) { return double(bytes) / 1000; }

/// Bytes of a series in KB; nothing where it was not made.
Cell series_cell(Thumbnail const& thumbnail, std::string_view codec, int frames) {
  std::size_t const bytes = series_bytes(thumbnail, codec, frames);
  return bytes ? Cell(kilobytes(bytes), 1) : Cell();
}

std::string format_name(std::string const& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  if (!ending.empty()) ending.erase(0, 1);
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return char(std::toupper(c)); });
  return ending;
}

std::vector<std::string> codecs(Study const& study) {
  std::vector<std::string> out;
  for (Model const& model : study.gallery.models)
    for (RivalSeries const& s : model.thumbnail.series)
      if (std::find(out.begin(), out.end(), s.codec) == out.end()) out.push_back(s.codec);
  return out;
}

/// A last row with the mean of each column of numbers.
void add_means(Table& table) {
  std::vector<Cell> means{Cell("mean")};
  for (std::size_t c = 1; c < table.columns.size(); ++c) {
    double sum = 0;
    int count = 0, digits = 0;
    for (auto const& row : table.rows)
      if (row[c].number) sum += *row[c].number, ++count, digits = row[c].digits;
    means.push_back(count ? Cell(sum / count, digits) : Cell());
  }
  table.rows.push_back(std::move(means));
  table.summary_rows = 1;
}

/// Columns for each texture size of the paper's thumbnails, then one for the gallery's own.
Table by_texture(Study const& study, std::string name, std::string caption, double (*figure)(Thumbnail const&),
                 int digits) {
  Table table{std::move(name), std::move(caption), {"model"}, {}};
  for (Trial const* trial : paper_trials(study)) table.columns.push_back(fmt::format("{0} x {0}", trial->setting.size));
  table.columns.push_back("this gallery");
  Values const values = paper_values(study, figure);
  for (std::size_t m = 0; m < values.size(); ++m) {
    Model const& model = study.gallery.models[m];
    table.rows.push_back({Cell(model.title)});
    for (auto const& value : values[m]) table.rows.back().push_back(Cell(value, digits));
    table.rows.back().push_back(Cell(figure(model.thumbnail), digits));
  }
  return table;
}

std::vector<Cell> verdict_row(Model const& model) {
  Thumbnail const& thumbnail = model.thumbnail;
  Verdict const found = verdict(thumbnail.bytes, thumbnail.mse1e4, thumbnail.series);
  std::vector<Cell> row{Cell(model.title), Cell(found.thumbnail_wins ? "3D" : "series"),
                        Cell(kilobytes(thumbnail.bytes), 1), Cell(thumbnail.mse1e4, 2)};
  if (found.rival)
    row.insert(row.end(), {Cell(fmt::format("{} frames, {}", found.rival->frames, codec_name(found.rival->codec))),
                           Cell(kilobytes(found.rival->bytes), 1), Cell(found.rival->turning_mse1e4, 2)});
  else
    row.insert(row.end(), {Cell("none is as good"), Cell(), Cell()});
  std::size_t const eight = series_bytes(thumbnail, "webp80", 8);
  row.push_back(eight == 0 ? Cell() : Cell(thumbnail.bytes < eight ? "3D" : "series"));
  return row;
}

}  // namespace

std::string codec_name(std::string_view codec) {
  std::size_t const digits = std::min(codec.find_first_of("0123456789"), codec.size());
  std::string name(codec.substr(0, digits));
  if (name == "jpeg") name = "JPEG";
  if (name == "webp") name = "WebP";
  if (name == "avif") name = "AVIF";
  return digits == codec.size() ? name : name + " q" + std::string(codec.substr(digits));
}

Table table1(Study const& study) {
  Table table{
      "table1", "Table 1. The models", {"model", "file", "format", "colour", "triangles", "size, MB", "covers, %"}, {}};
  for (Model const& model : study.gallery.models)
    table.rows.push_back({Cell(model.title), Cell(model.input), Cell(format_name(model.input)),
                          Cell(model.coloured ? "coloured" : "none"), Cell(double(model.triangles), 0),
                          Cell(double(model.bytes) / 1e6, 2), Cell(100 * model.thumbnail.coverage, 1)});
  return table;
}

Table table2(Study const& study) {
  Table table{"table2", "Table 2. Image series: KB by coding and number of views", {"model"}, {}};
  std::vector<std::string> const all = codecs(study);
  for (std::string const& codec : all)
    for (int frames : kFrames) table.columns.push_back(fmt::format("{}, {}", codec_name(codec), frames));
  for (Model const& model : study.gallery.models) {
    table.rows.push_back({Cell(model.title)});
    for (std::string const& codec : all)
      for (int frames : kFrames) table.rows.back().push_back(series_cell(model.thumbnail, codec, frames));
  }
  add_means(table);
  return table;
}

Table table3(Study const& study) {
  Table table = by_texture(
      study, "table3", "Table 3. Thumbnails: KB by texture size with the paper's choices, image series beside",
      [](Thumbnail const& t) { return kilobytes(t.delivered); }, 1);
  table.columns.insert(table.columns.end(), {"8 views JPEG q90", "8 views WebP q80"});
  for (std::size_t m = 0; m < table.rows.size(); ++m)
    for (char const* codec : {"jpeg90", "webp80"})
      table.rows[m].push_back(series_cell(study.gallery.models[m].thumbnail, codec, 8));
  add_means(table);
  return table;
}

Table table4(Study const& study) {
  Table table = by_texture(
      study, "table4", "Table 4. Thumbnails: mean square error x 10^4 by texture size with the paper's choices",
      [](Thumbnail const& t) { return t.mse1e4; }, 2);
  add_means(table);
  return table;
}

Table verdicts(Study const& study) {
  Table table{"verdicts",
              "3D or image series at the same quality",
              {"model", "verdict", "thumbnail, KB", "its MSE x 10^4", "rival", "rival, KB", "its turning MSE x 10^4",
               "by bytes alone, against 8 views WebP q80"},
              {}};
  for (Model const& model : study.gallery.models) table.rows.push_back(verdict_row(model));
  return table;
}

}  // namespace vitrine::report
