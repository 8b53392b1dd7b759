// SPDX-License-Identifier: Apache-2.0
#include "tools/report/svg.h"

#include "tools/report/escape.h"

#include <fmt/format.h>

namespace vitrine::report {
namespace {

constexpr std::string_view kDashes[kHues] = {"", "7 4", "2 3", "9 3 2 3", "5 2", "1 4"};

/// Circle, square, triangle, diamond, cross, triangle on its head; about (0, 0), some 9 pixels across.
constexpr std::string_view kShapes[kHues] = {"M-4.5 0a4.5 4.5 0 1 0 9 0a4.5 4.5 0 1 0 -9 0z",
                                             "M-4 -4h8v8h-8z",
                                             "M0 -5l5 9h-10z",
                                             "M0 -5.5l5.5 5.5l-5.5 5.5l-5.5 -5.5z",
                                             "M-5 -2v4h3v3h4v-3h3v-4h-3v-3h-4v3z",
                                             "M0 5l5 -9h-10z"};

constexpr std::string_view kPage =
    "svg{background:#fff;color:#1d1f23}"
    "@media(prefers-color-scheme:dark){svg{background:#16181c;color:#e4e6ea}}";

constexpr std::string_view anchor_name(Anchor anchor) {
  return anchor == Anchor::start ? "start" : anchor == Anchor::middle ? "middle" : "end";
}

/// Tenths of a pixel: short, and the same on every machine.
std::string px(double v) {
  std::string text = fmt::format("{:.1f}", v);
  if (text.ends_with(".0")) text.resize(text.size() - 2);
  return text == "-0" ? "0" : text;
}

std::string tipped(std::string_view shape, std::string_view tip) {
  return fmt::format("<{}><title>{}</title></path>\n", shape, html(tip));
}

}  // namespace

std::string_view chart_style() {
  return ".chart{font:12px system-ui,sans-serif;fill:currentColor}"
         ".chart .small{font-size:10.5px}.chart .strong{font-weight:600}"
         ".chart .rule{stroke:currentColor;stroke-opacity:.2;fill:none}"
         ".chart .curve{stroke-width:2;fill:none}.chart .edge{stroke:var(--page);stroke-width:1}"
         ":root{--page:#fff;--h0:#0072b2;--h1:#d55e00;--h2:#00805d;--h3:#b0548a;--h4:#8a6d00;--h5:#5c6066}"
         "@media(prefers-color-scheme:dark){:root{--page:#16181c;--h0:#56b4e9;--h1:#ff9d4d;--h2:#2fd1a5;--h3:#e8a5cb;"
         "--h4:#f0e442;--h5:#a4a9b0}}"
         ".f0{fill:var(--h0)}.f1{fill:var(--h1)}.f2{fill:var(--h2)}.f3{fill:var(--h3)}.f4{fill:var(--h4)}.f5{fill:var(-"
         "-h5)}"
         ".l0{stroke:var(--h0)}.l1{stroke:var(--h1)}.l2{stroke:var(--h2)}.l3{stroke:var(--h3)}.l4{stroke:var(--h4)}"
         ".l5{stroke:var(--h5)}";
}

Svg::Svg(std::string id, double width, double height, std::string title, std::string description)
    : id_(std::move(id)),
      title_(std::move(title)),
      description_(std::move(description)),
      width_(width),
      height_(height) {}

void Svg::bar(Point corner, double width, double height, int hue, std::string_view tip) {
  body_ += tipped(fmt::format("path class=\"f{} edge\" d=\"M{} {}h{}v{}h-{}z\"", hue % kHues, px(corner.x),
                              px(corner.y), px(width), px(height), px(width)),
                  tip);
}

void Svg::rule(Point from, Point to) {
  body_ += fmt::format("<path class=\"rule\" d=\"M{} {}L{} {}\"/>\n", px(from.x), px(from.y), px(to.x), px(to.y));
}

void Svg::curve(std::vector<Point> const& points, int hue) {
  std::string path;
  for (Point const& p : points) path += fmt::format("{}{} {}", path.empty() ? "M" : "L", px(p.x), px(p.y));
  body_ += fmt::format("<path class=\"curve l{}\" stroke-dasharray=\"{}\" d=\"{}\"/>\n", hue % kHues,
                       kDashes[hue % kHues], path);
}

void Svg::marker(Point at, int hue, std::string_view tip) {
  body_ += tipped(fmt::format("path class=\"f{} edge\" transform=\"translate({} {})\" d=\"{}\"", hue % kHues, px(at.x),
                              px(at.y), kShapes[hue % kHues]),
                  tip);
}

void Svg::words(Point at, Anchor anchor, std::string_view text, std::string_view style) {
  body_ += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"{}\" class=\"{}\">{}</text>\n", px(at.x), px(at.y),
                       anchor_name(anchor), style, html(text));
}

void Svg::words_upwards(Point at, std::string_view text) {
  body_ += fmt::format("<text transform=\"translate({} {})rotate(-90)\" text-anchor=\"middle\">{}</text>\n", px(at.x),
                       px(at.y), html(text));
}

std::string Svg::fragment() const {
  return fmt::format(
      "<svg class=\"chart\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" role=\"img\" aria-labelledby=\"{2}t "
      "{2}d\">\n"
      "<title id=\"{2}t\">{3}</title><desc id=\"{2}d\">{4}</desc>\n{5}</svg>\n",
      px(width_), px(height_), id_, html(title_), html(description_), body_);
}

std::string Svg::file() const {
  std::string out = fragment();
  out.insert(4, " xmlns=\"http://www.w3.org/2000/svg\"");
  out.insert(out.find(">\n") + 1, fmt::format("<style>{}{}</style>", kPage, chart_style()));
  return out;
}

}  // namespace vitrine::report
