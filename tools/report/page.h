// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The page: GALLERY/paper.html, with its tables, charts and pictures in GALLERY/paper/.

#include "tools/report/study.h"

#include <filesystem>

namespace vitrine::report {

/// A picture below the gallery and what it shows.
struct Picture {
  std::string file;  ///< relative to the gallery; [a-z0-9/.-]
  std::string caption;
  int width = 0, height = 0;
};

/// Figures 1 and 5.
struct Pictures {
  std::string subject;          ///< title of the model whose stages are shown
  std::vector<Picture> stages;  ///< from original to thumbnail
  std::vector<std::optional<Picture>>
      sides;  ///< for each model: original, thumbnail, difference; none where one is gone
};

/// Writes the page last, so that it never names what is not there. The same bytes for the same study.
void publish_page(Study const& study, Pictures const& pictures);

}  // namespace vitrine::report
