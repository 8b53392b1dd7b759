// SPDX-License-Identifier: Apache-2.0
#include "tools/report/chart.h"

#include "tools/report/escape.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vitrine::report {
namespace {

constexpr double kWidth = 680, kLine = 17;

/// An axis: values from the first tick to the last over a stretch of pixels.
struct Axis {
  std::vector<double> ticks;
  double from = 0, to = 0;  ///< pixels
  bool logarithmic = false;

  double at(double value) const {
    auto const place = [&](double v) { return logarithmic ? std::log10(v) : v; };
    double const low = place(ticks.front()), high = place(ticks.back());
    return from + (to - from) * (place(value) - low) / (high - low);
  }
};

/// Names with their marks, in lines of two.
void legend(Svg& svg, Point at, std::vector<std::pair<std::string, int>> const& names, bool bars) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    Point const p{at.x + double(i % 2) * 300, at.y + double(i / 2) * kLine};
    auto const& [name, hue] = names[i];
    if (bars)
      svg.bar({p.x, p.y - 9}, 22, 10, hue, name);
    else {
      svg.curve({{p.x, p.y - 4}, {p.x + 24, p.y - 4}}, hue);
      svg.marker({p.x + 12, p.y - 4}, hue, name);
    }
    svg.words({p.x + 32, p.y}, Anchor::start, name);
  }
}

double legend_height(std::size_t names) { return kLine * double((names + 1) / 2) + 12; }

void draw_bar(Svg& svg, Axis const& axis, double y, StackedBar const& bar, std::vector<std::string> const& names,
              std::string const& unit) {
  double sum = 0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    double const before = sum;
    sum += bar.parts[i];
    double const left = axis.at(before), width = axis.at(sum) - left;
    if (width >= 0.05)
      svg.bar({left, y}, width, kLine, int(i),
              fmt::format("{}: {} {:.1f} {}", bar.label, names[i], bar.parts[i], unit));
  }
  svg.words({axis.at(sum) + 5, y + 12.5}, Anchor::start, fmt::format("{:.1f}", sum), "small");
}

std::vector<Curve> drawable(std::vector<Curve> curves) {
  auto const missing = [](CurvePoint const& p) { return !(p.x > 0) || !(p.y > 0); };
  for (Curve& curve : curves) std::erase_if(curve.points, missing);
  std::erase_if(curves, [](Curve const& curve) { return curve.points.empty(); });
  return curves;
}

Axis log_axis(std::vector<Curve> const& curves, double CurvePoint::*value, double from, double to) {
  double low = 1e300, high = 0;
  for (Curve const& curve : curves)
    for (CurvePoint const& p : curve.points) low = std::min(low, p.*value), high = std::max(high, p.*value);
  return {curves.empty() ? std::vector<double>{1, 10} : log_ticks(low, high), from, to, true};
}

void draw_curve(Svg& svg, Curve const& curve, Axis const& x, Axis const& y) {
  std::vector<Point> line;
  for (CurvePoint const& p : curve.points) line.push_back({x.at(p.x), y.at(p.y)});
  svg.curve(line, curve.hue);
  for (std::size_t i = 0; i < line.size(); ++i) {
    CurvePoint const& p = curve.points[i];
    svg.marker(line[i], curve.hue, fmt::format("{}, {}: {:.4g} across, {:.3g} up", curve.name, p.label, p.x, p.y));
    svg.words({line[i].x + 7, line[i].y - 5}, Anchor::start, p.label, "small");  // falling curves leave this side free
  }
}

}  // namespace

std::vector<double> linear_ticks(double most) {
  double const rough = std::max(most, 1e-9) / 8, power = std::pow(10, std::floor(std::log10(rough)));
  double step = 10 * power;
  for (double factor : {5, 2, 1})
    if (factor * power >= rough) step = factor * power;
  std::vector<double> ticks{0};
  while (ticks.back() < most || ticks.size() < 2) ticks.push_back(double(ticks.size()) * step);
  return ticks;
}

std::vector<double> log_ticks(double least, double most) {
  bool const wide = std::log10(most / least) >= 3;
  std::vector<double> ticks;
  for (int power = int(std::floor(std::log10(least))) - 1; ticks.size() < 2 || ticks.back() < most; ++power)
    for (double factor : {1, 2, 5}) {
      if (wide && factor != 1) continue;
      double const tick = factor * std::pow(10, power);
      if (tick <= least) ticks.clear();
      if (ticks.size() < 2 || ticks.back() < most) ticks.push_back(tick);
    }
  return ticks;
}

std::string tick_text(double value) { return fmt::format("{:.6g}", value); }

Svg stacked_bars(ChartText const& text, std::string const& unit, std::vector<std::string> const& names,
                 std::vector<StackedBar> const& bars) {
  double const left = 190, top = 8, row = kLine + 7;
  double const bottom = top + row * double(bars.size()) + 4;
  double most = 0;
  for (StackedBar const& bar : bars) most = std::max(most, std::accumulate(bar.parts.begin(), bar.parts.end(), 0.0));
  Axis const axis{linear_ticks(most), left, kWidth - 45};

  Svg svg(text.id, kWidth, bottom + 52 + legend_height(names.size()), text.title, text.description);
  for (double tick : axis.ticks) {
    svg.rule({axis.at(tick), top}, {axis.at(tick), bottom});
    svg.words({axis.at(tick), bottom + 15}, Anchor::middle, tick_text(tick));
  }
  svg.words({(axis.from + axis.to) / 2, bottom + 33}, Anchor::middle, unit);
  for (std::size_t i = 0; i < bars.size(); ++i) {
    double const y = top + row * double(i) + 3;
    svg.words({left - 8, y + 12.5}, Anchor::end, shortened(bars[i].label, 26));
    draw_bar(svg, axis, y, bars[i], names, unit);
  }
  std::vector<std::pair<std::string, int>> marks;
  for (std::size_t i = 0; i < names.size(); ++i) marks.emplace_back(names[i], int(i));
  legend(svg, {left - 130, bottom + 60}, marks, true);
  return svg;
}

Svg log_curves(ChartText const& text, std::string const& x_title, std::string const& y_title,
               std::vector<Curve> const& all) {
  std::vector<Curve> const curves = drawable(all);
  double const left = 64, right = kWidth - 48, top = 20, bottom = 336;
  Axis const x = log_axis(curves, &CurvePoint::x, left, right), y = log_axis(curves, &CurvePoint::y, bottom, top);

  Svg svg(text.id, kWidth, bottom + 52 + legend_height(curves.size()), text.title, text.description);
  for (double tick : x.ticks) {
    svg.rule({x.at(tick), top}, {x.at(tick), bottom});
    svg.words({x.at(tick), bottom + 16}, Anchor::middle, tick_text(tick));
  }
  for (double tick : y.ticks) {
    svg.rule({left, y.at(tick)}, {right, y.at(tick)});
    svg.words({left - 7, y.at(tick) + 4}, Anchor::end, tick_text(tick));
  }
  svg.words({(left + right) / 2, bottom + 35}, Anchor::middle, x_title);
  svg.words_upwards({16, (top + bottom) / 2}, y_title);
  for (Curve const& curve : curves) draw_curve(svg, curve, x, y);
  std::vector<std::pair<std::string, int>> marks;
  for (Curve const& curve : curves) marks.emplace_back(curve.name, curve.hue);
  legend(svg, {left, bottom + 60}, marks, false);
  return svg;
}

}  // namespace vitrine::report
