// SPDX-License-Identifier: Apache-2.0
#include "tools/gallery_page.h"

#include "io/publish.h"
#include "tools/report/escape.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <span>

namespace vitrine::tools {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using graph::ModelRow;

constexpr char kPostersHere[] = "<!-- posters -->";

std::string credit(ModelRow const& row) {
  std::string text;
  for (char const* key : {"credit", "licence"}) {
    auto const found = row.metadata.find(key);
    if (found != row.metadata.end() && !found->second.empty()) text += (text.empty() ? "" : ", ") + found->second;
  }
  return text;
}

std::string figure(ModelRow const& row) {
  std::string const name = report::html(row.title), by = report::html(credit(row));
  return fmt::format(
      "<figure><img src=\"{}\" alt=\"{}\" width=\"200\" height=\"200\" loading=\"lazy\"><figcaption>{}{}{}"
      "</figcaption></figure>\n",
      report::html(row.poster), name, name, by.empty() ? "" : "<br>", by);
}

/// Bytes of all objects as series, by coding and number of frames.
Json series_weight(std::vector<ModelRow> const& rows) {
  Json sums = Json::object();
  for (ModelRow const& row : rows)
    for (graph::SeriesSizes const& coding : row.series)
      for (graph::SeriesSize const& size : coding.sizes) {
        Json& sum = sums[coding.codec][std::to_string(size.frames)];
        sum = (sum.is_null() ? std::size_t(0) : sum.get<std::size_t>()) + size.bytes;
      }
  return sums;
}

}  // namespace

fs::path page_folder() {
  fs::path const program = fs::read_symlink("/proc/self/exe").parent_path();
  for (fs::path const& folder : {program / "viewer", program / "../share/vitrine/viewer"})
    if (fs::exists(folder / "index.html")) return folder;
  return {};
}

std::string with_posters(std::string const& page, std::vector<ModelRow> const& rows) {
  std::size_t const place = page.find(kPostersHere);
  if (place == std::string::npos) return page;
  std::string posters = "<noscript><div class=\"cards\">\n";
  for (ModelRow const& row : rows)
    if (row.status == "done") posters += figure(row);
  posters += "</div></noscript>";
  return page.substr(0, place) + posters + page.substr(place + sizeof kPostersHere - 1);
}

void publish_page(fs::path const& gallery, std::vector<ModelRow> const& rows, bool x3dom) {
  fs::path const page = page_folder();
  if (page.empty()) {
    fmt::print(stderr, "note: this build has no gallery page (build the target viewer); index.html is not written\n");
    return;
  }
  for (fs::directory_entry const& entry : fs::recursive_directory_iterator(page)) {
    if (!entry.is_regular_file()) continue;
    fs::path const name = fs::relative(entry.path(), page);
    if (name == "index.html" || (!x3dom && *name.begin() == "x3dom")) continue;
    io::publish_file(gallery / "viewer" / name, io::map_file(entry.path()).bytes);
  }
  io::publish_file(gallery / "index.html",
                   with_posters(std::string(io::text(io::map_file(page / "index.html"))), rows));
}

Json page_sizes() {
  fs::path const page = page_folder();
  if (page.empty() || !fs::exists(page / "sizes.json")) return Json::object();
  return Json::parse(io::text(io::map_file(page / "sizes.json")));
}

Json page_weight(fs::path const& gallery, std::vector<ModelRow> const& rows, Profile profile, Json const& sizes) {
  std::size_t objects = 0, thumbnails = 0, posters = 0;
  for (ModelRow const& row : rows) {
    if (row.status != "done") continue;
    ++objects;
    thumbnails += row.bytes.total;
    std::error_code missing;
    auto const size = fs::file_size(gallery / row.poster, missing);
    if (!missing) posters += size;
  }
  Json out = Json::object();
  if (sizes.contains("viewer")) out["viewer"] = sizes["viewer"];
  auto const decoder = std::string(EnumNames<Profile>::names[std::size_t(profile)]);
  if (Json const decoders = sizes.value("decoders", Json::object()); decoders.contains(decoder))
    out["decoder"] = decoders[decoder];
  out.update({{"objects", objects}, {"thumbnails", thumbnails}, {"posters", posters}, {"series", series_weight(rows)}});
  return out;
}

void keep_measured(fs::path const& gallery, Json& page) {
  fs::path const file = gallery / "gallery.json";
  if (!fs::exists(file)) return;
  Json const earlier = Json::parse(io::text(io::map_file(file)), nullptr, false);
  if (!earlier.is_object() || !earlier.contains("page") || !earlier["page"].contains("measured")) return;
  Json then = earlier["page"];
  Json const measured = then["measured"];
  then.erase("measured");
  if (then == page) page["measured"] = measured;
}

}  // namespace vitrine::tools
