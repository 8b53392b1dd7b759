// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What an object would weigh as a series of pictures instead, and how far such a series is off.

#include "stages/measure.h"
#include "stages/verdict.h"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace vitrine::graph {

struct SeriesSize {
  int frames = 0;
  std::size_t bytes = 0;      ///< one file a frame, added up
  double coding_mse1e4 = 0;   ///< decoded frames against lossless ones
  double turning_mse1e4 = 0;  ///< over all views of the reference: the nearest frame, decoded, against the true view
};

struct SeriesSizes {
  std::string codec;  ///< "jpeg90", "webp80", "avif65"
  std::vector<SeriesSize> sizes;
};

/// In:     a reference of the turntable. Series of 8, 16 and 32 frames, as far as these divide the number of its views:
///         the frames are among the views, so that each is coded once.
/// Out:    one entry for each coding: JPEG of quality 90 with full chroma and optimised Huffman tables, WebP of quality
///         80 (both as image tools write them), AVIF of about the same error as that WebP. The same at any number of
///         threads.
/// Errors: InvalidInput for another set of views.
/// Cost:   about 0.4 CPU seconds for 32 views of 200 pixels; 4 MB for each codec, one after the other.
std::vector<SeriesSizes> series_sizes(Reference const& reference);

/// The key `series` of certificate.json: {"jpeg90": {"8": {"bytes", "codingMse1e4", "turningMse1e4"}, "16": …}, …}.
nlohmann::ordered_json to_json(std::vector<SeriesSizes> const& series);

/// What a verdict compares a thumbnail with.
std::vector<RivalSeries> rivals(std::vector<SeriesSizes> const& series);

}  // namespace vitrine::graph
