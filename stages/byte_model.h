// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a recipe will weigh, before it is tried: how the search aims.

#include "stages/fit.h"

#include <span>

namespace vitrine {

constexpr double kHeaderBytes = 900;  ///< of a file without geometry and maps

constexpr int kUsualQuality = 50;                    ///< of a map whose bytes are not known yet
constexpr int kWorstQuality = 5, kBestQuality = 95;  ///< of a map that fills its room

double expected_bytes_per_texel(int map_quality);

/// With which the recipe's map will fill its ceiling, judged by the map of a trial; better by one in the same coding.
/// Between 5 and 95.
int likely_quality(Recipe const& recipe, Trial const& like);

/// Of a trial, as far as its few triangles tell.
double bytes_per_triangle(Trial const& trial);

/// Of a triangle of the one to a triangle of the other.
double relative_size(Recipe const& one, Recipe const& other);

/// From what the last trial of the same painting took, parted at creases likewise if there is one, scaled to the recipe's bits
/// and texels; rough figures, measured on scans, where there is none yet.
class ByteModel {
 public:
  ByteModel(Recipe const& recipe, std::span<Trial const> history);

  /// That fill so many bytes.
  int triangles(double bytes) const;
  /// The same beside a map of so many bytes.
  int triangles_beside(double map_bytes, double bytes) const;

 private:
  double per_triangle_, map_;
};

}  // namespace vitrine
