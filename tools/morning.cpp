// SPDX-License-Identifier: Apache-2.0
#include "tools/morning.h"

#include "tools/cores_words.h"
#include "tools/printable.h"
#include "tools/report/escape.h"

#include <fmt/format.h>

#include <algorithm>

namespace vitrine::tools {
namespace {

using graph::ModelRow;
using graph::Summary;
using report::html;

constexpr std::size_t kShown = 5;  ///< on the screen, of each list

constexpr char kStyle[] = R"(
:root { color-scheme: light dark; --line: #8884; --bad: #b3261e; --quiet: #666; }
@media (prefers-color-scheme: dark) { :root { --bad: #ff8a80; --quiet: #aaa; } }
body { font: 16px/1.5 system-ui, sans-serif; max-width: 70rem; margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.6rem; } h2 { font-size: 1.2rem; margin-top: 2rem; }
table { border-collapse: collapse; width: 100%; } th { text-align: left; }
td, th { border-bottom: 1px solid var(--line); padding: .3rem .6rem .3rem 0; vertical-align: top; }
td:first-child, td:last-child { overflow-wrap: anywhere; }
td.number, th.number { text-align: right; font-variant-numeric: tabular-nums; }
td.number { white-space: nowrap; }
@media (max-width: 40rem) { table { font-size: .78rem; } td, th { padding-right: .35rem; } }
.bad { color: var(--bad); white-space: nowrap; } .quiet { color: var(--quiet); } code { font-size: .9em; overflow-wrap: anywhere; }
)";

std::string hours(double seconds) {
  auto const s = long(seconds + 0.5);
  if (s < 60) return fmt::format("{:.1f} s", seconds);
  return s < 3600 ? fmt::format("{} min {} s", s / 60, s % 60) : fmt::format("{} h {} min", s / 3600, s / 60 % 60);
}

std::string size(std::uint64_t bytes) {
  return bytes < 1'000'000       ? fmt::format("{:.1f} KB", double(bytes) / 1e3)
         : bytes < 1'000'000'000 ? fmt::format("{:.1f} MB", double(bytes) / 1e6)
                                 : fmt::format("{:.2f} GB", double(bytes) / 1e9);
}

/// "12 of 20 models converted, …": the one line that says it all.
std::string headline(Summary const& s) {
  std::string text = fmt::format("{} of {} models done", s.done, s.models);
  if (s.up_to_date > 0) text += fmt::format(" ({} were up to date)", s.up_to_date);
  if (s.failed > 0) text += fmt::format(", {} failed", s.failed);
  if (s.quarantined > 0) text += fmt::format(", {} quarantined", s.quarantined);
  if (s.pending > 0) text += fmt::format(", {} not reached", s.pending);
  return text + fmt::format(", in {}", hours(s.seconds));
}

std::size_t new_problems(Summary const& s) {
  return std::size_t(std::count_if(s.problems.begin(), s.problems.end(), [](auto const& p) { return p.is_new; }));
}

std::string table_row(std::vector<std::string> const& cells, bool last_is_number) {
  std::string row = "<tr>";
  for (std::size_t i = 0; i < cells.size(); ++i)
    row += (last_is_number && i + 1 == cells.size() ? "<td class=\"number\">" : "<td>") + html(cells[i]) + "</td>";
  return row + "</tr>\n";
}

std::string problems_html(Summary const& s) {
  if (s.problems.empty()) return "";
  std::string out =
      "<h2>What went wrong</h2>\n<table><tr><th>Model</th><th></th><th>Where</th><th>Why, and what to do</th></tr>\n";
  for (Summary::Problem const& p : s.problems)
    out += fmt::format(
        "<tr><td>{}</td><td class=\"bad\">{}{}</td><td>{}</td><td>{}<br><span class=\"quiet\">{}</span></td></tr>\n",
        html(p.input), html(p.status), p.is_new ? ", new" : ", known", html(p.stage), html(p.reason), html(p.remedy));
  out += "</table>\n";
  if (!s.retry.empty())
    out += "<p>Once mended, the same command again converts them; nothing mended, but to be tried: <code>" +
           html(s.retry) + "</code></p>\n";
  return out;
}

template <class Value, class Shown>
std::string list_html(std::string const& title, std::string const& left, std::string const& right,
                      std::vector<std::pair<std::string, Value>> const& list, Shown const& show) {
  if (list.empty()) return "";
  std::string out =
      fmt::format("<h2>{}</h2>\n<table><tr><th>{}</th><th class=\"number\">{}</th></tr>\n", title, left, right);
  for (auto const& [name, value] : list) out += table_row({name, show(value)}, true);
  return out + "</table>\n";
}

std::string models_html(std::vector<ModelRow> const& rows) {
  std::string out =
      "<h2>All models</h2>\n<table><tr><th>Model</th><th></th><th class=\"number\">Bytes</th><th>To know</th></tr>\n";
  for (ModelRow const& row : rows) {
    std::string notes;
    for (std::string const& note : row.notes) notes += (notes.empty() ? "" : "<br>") + html(note);
    std::string const name =
        row.thumb.empty() ? html(row.input) : "<a href=\"" + html(row.thumb) + "\">" + html(row.input) + "</a>";
    out += fmt::format("<tr><td>{}</td><td>{}</td><td class=\"number\">{}</td><td class=\"quiet\">{}</td></tr>\n", name,
                       html(row.status), row.status == "done" ? size(row.bytes.total) : "", notes);
  }
  return out + "</table>\n";
}

}  // namespace

std::string summary_text(Summary const& s, std::string const& gallery) {
  std::string text = headline(s) + "\n";
  if (s.done > 0) text += fmt::format("{} each on average, {} on disk\n", size(s.bytes / s.done), size(s.disk));
  if (!s.problems.empty()) text += fmt::format("{} problems, {} of them new:\n", s.problems.size(), new_problems(s));
  for (std::size_t i = 0; i < std::min(kShown, s.reasons.size()); ++i)
    text += fmt::format("  {} x {}\n", s.reasons[i].second, printable(s.reasons[i].first));
  if (s.reasons.size() > kShown)
    text += fmt::format("  and {} other reasons, see report.html\n", s.reasons.size() - kShown);
  if (!s.retry.empty()) text += "try them again: " + printable(s.retry) + "\n";
  if (!s.orphans.empty())
    text += fmt::format("{} folders in models/ belong to nothing in the archive; convert --prune removes them\n",
                        s.orphans.size());
  if (!s.guard.reason.empty())
    text += "ended early: " + printable(s.guard.reason) + "; the same command goes on where it stopped\n";
  if (!s.stages.empty())
    for (std::string const& line :
         {stages_words(s.stages), memory_words(s.guard.occupancy), cores_words(s.guard.occupancy)})
      text += line + "\n";
  if (s.pending == 0) text += "look at it: vitrine serve " + printable(gallery) + "\n";
  return text;
}

std::string summary_html(Summary const& s, std::vector<ModelRow> const& rows) {
  std::string out =
      "<!doctype html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width, initial-scale=1\">\n"
      "<link rel=\"icon\" href=\"data:,\">\n"
      "<title>Vitrine: report</title><style>" +
      std::string(kStyle) + "</style></head>\n<body>\n<h1>" + html(headline(s)) + "</h1>\n<p>";
  if (s.done > 0) out += fmt::format("{} each on average, {} on disk. ", size(s.bytes / s.done), size(s.disk));
  if (!s.problems.empty()) out += fmt::format("{} problems, {} of them new. ", s.problems.size(), new_problems(s));
  if (!s.guard.reason.empty()) out += "Ended early: " + html(s.guard.reason) + ". ";
  out += "<span class=\"quiet\">Models were opened under: " + html(s.guard.confinement) + ".</span></p>\n";
  out += list_html("Reasons", "Stage and reason", "Models", s.reasons, [](std::size_t n) { return std::to_string(n); });
  out += problems_html(s);
  out += list_html("Slowest of this run", "Model", "Time", s.slowest, hours);
  out += stages_html(s.stages);
  if (!s.stages.empty())
    out += "<p>The run was " + html(cores_words(s.guard.occupancy)) + "; " + html(memory_words(s.guard.occupancy)) +
           ".</p>\n";
  out += list_html("Repairs", "What was mended or dropped", "Count", s.repairs,
                   [](std::uint64_t n) { return std::to_string(n); });
  return out + models_html(rows) + "</body>\n</html>\n";
}

}  // namespace vitrine::tools
