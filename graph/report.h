// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a run says of each model: one row per input, also for those that failed, in the archive's order.

#include "stages/clean.h"
#include "stages/data.h"

#include <nlohmann/json_fwd.hpp>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace vitrine::graph {

struct Failure {
  std::string stage, reason, remedy;
};

struct ModelRow {
  std::string input;  ///< path in the archive
  std::string slug, title;
  std::map<std::string, std::string> metadata;
  std::string status = "failed";  ///< "done" or "failed"
  Failure failure;                ///< of a failed one
  std::string thumb;              ///< path in the gallery, of a finished one

  std::uint64_t input_bytes = 0, memory = 0;  ///< memory: as admitted
  std::uint64_t source_triangles = 0, source_vertices = 0;
  bool source_coloured = false;
  Repairs repairs;
  std::vector<std::string> notes;

  std::uint32_t charts = 0, chart_retries = 0;
  float simplify_error = 0, atlas_fill = 0;
  BakeStatistics bake;
  std::uint32_t triangles = 0, vertices = 0;
  struct Bytes {
    std::size_t total = 0, geometry = 0, colour = 0, normal = 0, occlusion = 0, other = 0;
  } bytes;

  std::vector<std::pair<std::string, double>> seconds;  ///< wall time per stage, in order; waiting excluded
};

/// One line for people: "error: office/ch_03.obj: segment: …; try …".
std::string describe(ModelRow const& failed);

/// report.json (schema 1). `options` as given by the caller; `wall_seconds` of the whole run.
nlohmann::ordered_json report_json(std::vector<ModelRow> const& rows, nlohmann::ordered_json const& options,
                                   double wall_seconds);

/// report.csv: the same rows, flat. Cells that a spreadsheet would take for a formula are quoted with an apostrophe.
std::string report_csv(std::vector<ModelRow> const& rows);

/// gallery.json (schema 1): what the gallery page shows.
nlohmann::ordered_json gallery_json(std::vector<ModelRow> const& rows);

}  // namespace vitrine::graph
