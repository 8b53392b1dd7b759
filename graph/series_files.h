// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A series of pictures as a folder that a viewer can show: frames, a sheet of them, an animation, and series.json.
///
/// For each object of a run:
///     publish_series(gallery / "models" / slug / "series", series_files(original, reference, options));
/// with the reference that the measure has made of it anyway.

#include "graph/series_coding.h"
#include "stages/measure.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace vitrine::graph {

struct SeriesOptions {
  int frames = 32;
  int rows = 1;
  SeriesCodec codec = SeriesCodec::jpeg;
  int quality = 0;
  bool single = true;
  bool sheet = false;
  bool animated = false;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(self.frames, Field{"frames", "pictures", "once round the object", 1, 360});
    visit(self.rows, Field{"rows", "rows", "further turns, evenly from 10 to 80 degrees above the horizon", 1, 32});
    visit(self.codec, Field{"codec", "", "of the frames and the sheet"});
    visit(self.quality, Field{"quality", "of 100", "0: 90 for JPEG, 80 for WebP, 65 for AVIF", 0, 100});
    visit(self.single, Field{"single", "", "write one file for each frame"});
    visit(self.sheet, Field{"sheet", "", "write one image with all frames"});
    visit(self.animated, Field{"animated", "", "write the lowest row as an animated WebP"});
  }
};

struct SeriesFile {
  std::string name;
  std::vector<std::byte> bytes;
};

struct SeriesFiles {
  std::vector<SeriesFile> files;    ///< frames row by row, then the sheet, then the animation
  nlohmann::ordered_json manifest;  ///< series.json, see docs/series.md
};

/// Size and light are those of `reference`; its pictures serve as frames where they are the same views, others are
/// drawn. Where they are a turntable, the error of turning is measured over them.
/// Errors: InvalidInput if the series has more than 1024 pictures, or its sheet is larger than the codec holds.
/// Cost:   all pictures in memory at once: 10 bytes a pixel.
SeriesFiles series_files(SurveyedModel const& original, Reference const& reference, SeriesOptions const& options);

/// Of other pictures, photographs say: frames x rows of them, row by row, RGB, all of one size, from wherever they were
/// taken.
/// Errors: as above; InvalidInput if they are not as many as the options say.
SeriesFiles series_files(std::vector<Image> const& pictures, SeriesOptions const& options);

/// Every file whole, series.json last; then removes what the series.json of an earlier series there names and this one
/// does not have. Errors: those of io::publish_file.
void publish_series(std::filesystem::path const& folder, SeriesFiles const& series);

}  // namespace vitrine::graph
