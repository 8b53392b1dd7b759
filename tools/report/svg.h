// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Drawings of lines, bars and words that look right on light and dark pages and to the colour-blind.

#include <string>
#include <string_view>
#include <vector>

namespace vitrine::report {

struct Point {
  double x = 0, y = 0;
};

enum class Anchor { start, middle, end };

/// Colours of what is told apart: Okabe and Ito's for the colour-blind, darker on light pages, lighter on dark ones.
inline constexpr int kHues = 6;

/// The style sheet that fragments need, once in the page.
std::string_view chart_style();

/// x to the right, y down, in pixels. All words are escaped here. The title and description stand in for the drawing
/// where it cannot be seen.
class Svg {
 public:
  /// `id`: unique in the page, of letters and digits.
  Svg(std::string id, double width, double height, std::string title, std::string description);

  void bar(Point corner, double width, double height, int hue, std::string_view tip);
  void rule(Point from, Point to);                        ///< thin: a grid line or an axis
  void curve(std::vector<Point> const& points, int hue);  ///< each hue has its own dashes
  void marker(Point at, int hue, std::string_view tip);   ///< each hue has its own shape
  void words(Point at, Anchor anchor, std::string_view text,
             std::string_view style = "");              ///< style: "small", "strong"
  void words_upwards(Point at, std::string_view text);  ///< turned by a quarter, centred

  std::string const& title() const { return title_; }
  std::string fragment() const;  ///< for a page that holds chart_style()
  std::string file() const;      ///< by itself

 private:
  std::string id_, title_, description_, body_;
  double width_, height_;
};

}  // namespace vitrine::report
