// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The figures that the paper is made of: a gallery's own thumbnails, and the same originals at other settings.

#include "graph/pipeline.h"
#include "tools/report/gallery.h"
#include "tools/report/statistics.h"

#include <optional>
#include <string>
#include <vector>

namespace vitrine::report {

/// A way to make thumbnails.
struct Setting {
  std::string name;    ///< "paper-256"; of its folder, too
  bool paper = false;  ///< the paper's choices, else Vitrine's search
  int size = 0;        ///< texels a side of the paper's textures; KB that the search may spend
  graph::ModelOptions options;
};

/// What one setting made of each model, in the gallery's order; none where it failed.
struct Trial {
  Setting setting;
  std::vector<std::optional<Thumbnail>> thumbnails;
};

struct Study {
  Gallery gallery;
  std::vector<Trial> trials;
  std::vector<Trial>
      ablation;  ///< the search with everything, then without each of its choices; none where not asked for
};

/// The paper's choices at each texture size, and Vitrine's search under rising ceilings; originals read and measured as
/// `gallery`'s.
std::vector<Setting> settings(std::vector<int> const& textures, graph::ModelOptions const& gallery);

/// For Study::ablation.
std::vector<Setting> ablation_settings(graph::ModelOptions const& gallery);

/// The trials with the paper's choices, by texture size.
std::vector<Trial const*> paper_trials(Study const& study);

/// One figure of the paper's thumbnails, model by texture size.
Values paper_values(Study const& study, double (*figure)(Thumbnail const&));

}  // namespace vitrine::report
