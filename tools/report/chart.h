// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Two kinds of chart: stacked bars, and curves over two logarithmic axes.

#include "tools/report/svg.h"

#include <string>
#include <vector>

namespace vitrine::report {

/// What a chart is called and how it is told in words.
struct ChartText {
  std::string id, title, description;
};

struct StackedBar {
  std::string label;
  std::vector<double> parts;  ///< as many as there are names
};

/// Horizontal bars, one a row, their sums at their ends. In: at least one bar; parts not negative.
Svg stacked_bars(ChartText const& text, std::string const& unit, std::vector<std::string> const& names,
                 std::vector<StackedBar> const& bars);

struct CurvePoint {
  double x = 0, y = 0;  ///< above 0
  std::string label;
};
struct Curve {
  std::string name;
  int hue = 0;
  std::vector<CurvePoint> points;
};

/// Curves with a marker at each point. Points that are not above 0 have no place on a logarithmic axis and are left
/// out.
Svg log_curves(ChartText const& text, std::string const& x_title, std::string const& y_title,
               std::vector<Curve> const& curves);

/// Round steps (1, 2 or 5 times a power of ten) from 0 to at least `most`, four to nine of them.
std::vector<double> linear_ticks(double most);

/// 1, 2 and 5 times powers of ten, from at most `least` to at least `most`; powers of ten alone over three decades or
/// more.
std::vector<double> log_ticks(double least, double most);

/// As short as can be: "0.05", "2", "500".
std::string tick_text(double value);

}  // namespace vitrine::report
