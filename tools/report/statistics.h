// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the figures of many models have in common.

#include <cstddef>
#include <optional>
#include <vector>

namespace vitrine::report {

/// One value for each model (row) and setting (column); none where a model could not be made.
using Values = std::vector<std::vector<std::optional<double>>>;

/// Rows that have a value in every column.
std::vector<std::vector<double>> complete_rows(Values const& values);

/// How much of all squared deviations from the mean each factor explains; the three add up to 1.
struct VarianceShares {
  double rows = 0, columns = 0, rest = 0;
};

/// Two-way analysis of variance without replication. None with fewer than 2 rows or columns, or if nothing varies.
std::optional<VarianceShares> variance_shares(std::vector<std::vector<double>> const& table);

/// Pearson's coefficient. None with fewer than 3 pairs, or if either side does not vary.
std::optional<double> correlation(std::vector<double> const& x, std::vector<double> const& y);

/// Exp of the mean logarithm of positive values; 0 where one is 0.
double geometric_mean(std::vector<double> const& values);

/// A value above the one to its left.
struct Rise {
  std::size_t row, column;
};
std::vector<Rise> rises(Values const& values);

}  // namespace vitrine::report
