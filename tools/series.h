// SPDX-License-Identifier: Apache-2.0
#pragma once
/// vitrine series: the rival of a thumbnail, a series of pictures.

#include "graph/series_files.h"
#include "io/archive.h"
#include "io/read_model.h"

#include <filesystem>
#include <functional>
#include <vector>

namespace vitrine::tools {

struct SeriesCommand {
  std::filesystem::path original;  ///< any format that is read; empty with `pictures`
  std::filesystem::path pictures;  ///< folder of pictures from elsewhere; empty with `original`
  std::filesystem::path out;
  io::ReadOptions read;
  io::UpAxis up = io::UpAxis::y;
  MeasureOptions measure;  ///< size and light of the pictures; its 32 views tell the error of turning
  graph::SeriesOptions series;
  bool all_pictures = true;  ///< as many frames as there are pictures; else every so many, as --frames says
  bool json = false;         ///< print series.json instead of a summary
};

/// The image series of the paper's table 2: so many views of 200 pixels, JPEG (whose usual quality is the paper's 90).
/// What the user has `given` stays: it is asked for "--frames", "--rows", "--codec" and "--size".
void take_paper_series(SeriesCommand& command, int frames, std::function<bool(char const* flag)> const& given);

/// Writes the series, prints what it weighs.
/// Errors: those of the readers, naming the file; InvalidInput where the pictures are not enough or no picture is
///         there.
int series(SeriesCommand const& command);

/// The images of a folder by name, numbers in names by value: view-2 before view-10. Files that are no images, by their
/// ending, are left out.
std::vector<std::filesystem::path> pictures_in(std::filesystem::path const& folder);

}  // namespace vitrine::tools
