// SPDX-License-Identifier: Apache-2.0
#include "tools/report/statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vitrine::report {
namespace {

double mean(std::vector<double> const& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

/// Sum of squared deviations from `centre`.
double spread(std::vector<double> const& values, double centre) {
  double sum = 0;
  for (double v : values) sum += (v - centre) * (v - centre);
  return sum;
}

}  // namespace

std::vector<std::vector<double>> complete_rows(Values const& values) {
  std::vector<std::vector<double>> table;
  for (auto const& row : values) {
    if (!std::all_of(row.begin(), row.end(), [](auto const& value) { return value.has_value(); })) continue;
    table.emplace_back();
    for (auto const& value : row) table.back().push_back(*value);
  }
  return table;
}

std::optional<VarianceShares> variance_shares(std::vector<std::vector<double>> const& table) {
  if (table.size() < 2 || table[0].size() < 2) return {};
  std::size_t const rows = table.size(), columns = table[0].size();
  std::vector<double> row_means, column_means(columns, 0.0), all;
  for (auto const& row : table) {
    row_means.push_back(mean(row));
    for (std::size_t c = 0; c < columns; ++c) column_means[c] += row[c] / double(rows);
    all.insert(all.end(), row.begin(), row.end());
  }
  double const centre = mean(all), total = spread(all, centre);
  if (!(total > 0)) return {};
  double const by_row = double(columns) * spread(row_means, centre) / total;
  double const by_column = double(rows) * spread(column_means, centre) / total;
  return VarianceShares{by_row, by_column, std::max(0.0, 1 - by_row - by_column)};
}

std::optional<double> correlation(std::vector<double> const& x, std::vector<double> const& y) {
  if (x.size() < 3 || x.size() != y.size()) return {};
  double const mx = mean(x), my = mean(y), sx = spread(x, mx), sy = spread(y, my);
  if (!(sx > 0) || !(sy > 0)) return {};
  double together = 0;
  for (std::size_t i = 0; i < x.size(); ++i) together += (x[i] - mx) * (y[i] - my);
  return together / std::sqrt(sx * sy);
}

double geometric_mean(std::vector<double> const& values) {
  double sum = 0;
  for (double v : values) sum += std::log(v);
  return values.empty() ? 0 : std::exp(sum / double(values.size()));
}

std::vector<Rise> rises(Values const& values) {
  std::vector<Rise> out;
  for (std::size_t r = 0; r < values.size(); ++r)
    for (std::size_t c = 1; c < values[r].size(); ++c) {
      auto const &before = values[r][c - 1], &now = values[r][c];
      if (before && now && *now > *before) out.push_back({r, c});
    }
  return out;
}

}  // namespace vitrine::report
