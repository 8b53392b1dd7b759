// SPDX-License-Identifier: Apache-2.0
#include "tools/report/page.h"

#include "io/publish.h"
#include "tools/report/ablation.h"
#include "tools/report/escape.h"
#include "tools/report/figures.h"
#include "tools/report/page_table.h"
#include "tools/report/paper_tables.h"
#include "tools/report/words.h"

#include <fmt/format.h>

namespace vitrine::report {
namespace {

constexpr std::string_view kStyle = R"(
:root{color-scheme:light dark;--ink:#1d1f23;--soft:#5c6066;--line:#d9dbdf;--link:#0060a8}
@media(prefers-color-scheme:dark){:root{--ink:#e4e6ea;--soft:#a4a9b0;--line:#363a41;--link:#7cc4ff}}
*{box-sizing:border-box}
body{margin:0;background:var(--page);color:var(--ink);font:16px/1.5 system-ui,sans-serif}
main{max-width:1120px;margin:0 auto;padding:24px 16px 64px}
h1{font-size:1.75rem;line-height:1.2;margin:.5em 0 .3em}h2{font-size:1.3rem;margin:2.2em 0 .6em}h3{font-size:1.05rem;margin:2em 0 .4em}
p,li{max-width:72ch}a{color:var(--link)}.soft{color:var(--soft)}bdi,h3,caption,figcaption{overflow-wrap:break-word}tbody th{max-width:22em}
.table{overflow-x:auto;margin:1em 0}table{border-collapse:collapse;font-size:.88rem}
caption{text-align:left;font-weight:600;padding:0 0 .5em}
th,td{padding:.35em .7em;border-bottom:1px solid var(--line);text-align:left;vertical-align:top}
thead th{vertical-align:bottom;font-weight:600}tbody th{font-weight:400;min-width:8em}tbody td{white-space:nowrap}
.number{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}.summary th,.summary td{font-weight:600;border-top:2px solid var(--line)}
figure{margin:1.2em 0}.scroll{overflow-x:auto}.scroll svg{display:block;min-width:560px;max-width:100%;height:auto}
.files{font-size:.85rem;margin:.2em 0}
.stages{display:grid;grid-template-columns:repeat(auto-fill,minmax(150px,1fr));gap:14px;margin:1em 0}
.stages figure{margin:0}.stages img{width:100%}img{height:auto;max-width:100%;background:#fff;border-radius:4px;display:block}
figcaption{font-size:.85rem;color:var(--soft);margin-top:.4em}
.model{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,440px),1fr));gap:20px;align-items:start}.model figure{margin:0}.model .scroll svg{min-width:480px}
)";

std::string file_link(std::string const& file, std::string const& text) {
  return fmt::format("<a href=\"paper/{}\">{}</a>", file, text);
}

std::string section(Table const& table) {
  return to_html(table) + fmt::format("<p class=\"files\">{} &middot; {}</p>\n", file_link(table.name + ".csv", "CSV"),
                                      file_link(table.name + ".md", "Markdown"));
}

std::string section(Svg const& chart, std::string const& file) {
  return fmt::format(
      "<figure><figcaption><strong>{}</strong> &middot; {}</figcaption><div class=\"scroll\">{}</div></figure>\n",
      html(chart.title()), file_link(file, "SVG"), chart.fragment());
}

std::string picture(Picture const& p, std::string const& alternative) {
  return fmt::format(
      "<figure><img src=\"{}\" alt=\"{}\" width=\"{}\" height=\"{}\" "
      "loading=\"lazy\"><figcaption>{}</figcaption></figure>\n",
      html(p.file), html(alternative), p.width, p.height, html(p.caption));
}

std::string stages_section(Pictures const& pictures) {
  if (pictures.stages.empty()) return "";
  std::string out = "<h2>From scan to thumbnail</h2>\n<p>Figure 1. The stages of <bdi>" + html(pictures.subject) +
                    "</bdi>.</p>\n<div class=\"stages\">";
  for (Picture const& p : pictures.stages) out += picture(p, pictures.subject + ": " + p.caption);
  return out + "</div>\n";
}

std::string model_section(Study const& study, Pictures const& pictures, std::size_t m) {
  Model const& model = study.gallery.models[m];
  std::string out =
      fmt::format("<h3 id=\"{}\"><bdi>{}</bdi></h3>\n<div class=\"model\">", model.slug, html(model.title));
  if (pictures.sides[m])
    out += picture(*pictures.sides[m], model.title + ": original, thumbnail and their squared difference side by side");
  Svg const chart = curves_of(study, m);
  return out + section(chart, "curves-" + model.slug + ".svg") + "</div>\n";
}

std::string intro(Study const& study) {
  Json const& measure = study.gallery.models.front().certificate.at("measure");
  std::string out = fmt::format(
      "<p>{} of this gallery, measured as in Limper et al. 2015, &ldquo;Evaluating 3D Thumbnails for Virtual Object "
      "Galleries&rdquo;, section 4: {} {} views of {} x {} pixels, mean square error of R, G and B in [0, 1] over all "
      "pixels, times "
      "10<sup>4</sup>. KB are 1000 bytes.</p>\n",
      study.gallery.models.size() == 1 ? "One model" : fmt::format("{} models", study.gallery.models.size()),
      measure.at("views").get<int>(), html(measure.at("set").get<std::string>()), measure.at("size").get<int>(),
      measure.at("size").get<int>());
  if (study.gallery.left_out.empty()) return out;
  out += "<p>Left out, because not measured:";
  for (std::string const& input : study.gallery.left_out)
    out += " <bdi>" + html(input) + "</bdi>" + (&input == &study.gallery.left_out.back() ? "." : ",");
  return out + "</p>\n";
}

std::string findings_section(Study const& study) {
  std::string out = "<h2>What the figures say</h2>\n<ul>\n";
  for (std::string const& finding : findings(study)) out += "<li>" + html(finding) + "</li>\n";
  return out + "</ul>\n";
}

std::string made_with(Study const& study) {
  std::string out =
      "<h2>How these were made</h2>\n<p>&ldquo;This gallery&rdquo; is what <code>vitrine convert</code> wrote, with "
      "the options in "
      "<a href=\"report.json\">report.json</a>. For the rest <code>vitrine report</code> converted the same originals "
      "again:</p>\n<ul>\n";
  for (Trial const& trial : study.trials) {
    Setting const& setting = trial.setting;
    out += setting.paper
               ? fmt::format("<li>the paper&#39;s choices: {} triangles at most, textures of {} texels a side</li>\n",
                             setting.options.simplify.triangles, setting.size)
               : fmt::format("<li>Vitrine&#39;s search for the best file of at most {} KB</li>\n", setting.size);
  }
  return out +
         "</ul>\n<p>The paper&#39;s choices are those of <code>--preset paper</code>; their bytes are those of the zip "
         "for X3DOM, as "
         "the paper counted. It gave models without colour grey ambient occlusion, so there both the thumbnail and its "
         "original are drawn with it, and the error is not that of the same pictures as elsewhere on this page.</p>\n";
}

/// The charts that are about all models.
struct Charts {
  explicit Charts(Study const& study)
      : bars(figure4(study)), bars_by_texture(figure4_by_texture(study)), curves(curves_of_all(study)) {}
  Svg bars, bars_by_texture, curves;
};

void publish_tables(Study const& study, std::filesystem::path const& folder) {
  std::vector<Table> tables{table1(study), table2(study),   table3(study),
                            table4(study), verdicts(study), page_table(study.gallery)};
  if (Table waited = wait_table(study.gallery); !waited.rows.empty()) tables.push_back(std::move(waited));
  if (!study.ablation.empty()) tables.push_back(ablation(study));
  for (Table const& table : tables) {
    io::publish_file(folder / (table.name + ".csv"), to_csv(table));
    io::publish_file(folder / (table.name + ".md"), to_markdown(table));
  }
}

void publish_charts(Study const& study, Charts const& charts, std::filesystem::path const& folder) {
  io::publish_file(folder / "figure4.svg", charts.bars.file());
  io::publish_file(folder / "figure4-texture.svg", charts.bars_by_texture.file());
  io::publish_file(folder / "curves.svg", charts.curves.file());
  for (std::size_t m = 0; m < study.gallery.models.size(); ++m)
    io::publish_file(folder / ("curves-" + study.gallery.models[m].slug + ".svg"), curves_of(study, m).file());
}

std::string head() {
  return "<!doctype html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\"><meta name=\"viewport\" "
         "content=\"width=device-width,initial-scale=1\">\n<link rel=\"icon\" href=\"data:,\">\n<title>3D thumbnails "
         "against image series</title>\n<style>" +
         std::string(chart_style()) + std::string(kStyle) + "</style></head>\n";
}

std::string body(Study const& study, Charts const& charts, Pictures const& pictures) {
  std::string out = "<body><main>\n<h1>3D thumbnails against image series</h1>\n" + intro(study) +
                    findings_section(study) + section(verdicts(study)) + stages_section(pictures);
  out += "<h2>Models and series</h2>\n" + section(table1(study)) + section(table2(study));
  out += "<h2>Bytes</h2>\n" + section(table3(study)) + section(charts.bars, "figure4.svg") +
         section(charts.bars_by_texture, "figure4-texture.svg");
  out += "<h2>Error</h2>\n" + section(table4(study)) + section(charts.curves, "curves.svg");
  if (Table const page = page_table(study.gallery); !page.rows.empty())
    out +=
        "<h2>What visitors load</h2>\n<p>Code is counted once, as by gzip; posters, which both have, are not. Times "
        "are those of the bytes alone.</p>\n" +
        section(page);
  if (Table const waited = wait_table(study.gallery); !waited.rows.empty()) out += section(waited);
  if (!study.ablation.empty()) out += "<h2>The search</h2>\n" + section(ablation(study));
  out += "<h2>Model by model</h2>\n<p>Figure 5: original, thumbnail, and their squared difference times 8.</p>\n";
  for (std::size_t m = 0; m < study.gallery.models.size(); ++m) out += model_section(study, pictures, m);
  return out + made_with(study) + "</main></body></html>\n";
}

}  // namespace

void publish_page(Study const& study, Pictures const& pictures) {
  std::filesystem::path const folder = study.gallery.folder / "paper";
  Charts const charts(study);
  publish_tables(study, folder);
  publish_charts(study, charts, folder);
  io::publish_file(study.gallery.folder / "paper.html", head() + body(study, charts, pictures));
}

}  // namespace vitrine::report
