// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a run says of each model: one row per input, also for those that failed, in the archive's order.

#include "graph/series_sizes.h"
#include "io/archive.h"
#include "io/dependencies.h"
#include "stages/angle_error.h"
#include "stages/clean.h"
#include "stages/compare.h"
#include "stages/data.h"
#include "stages/fit.h"
#include "stages/measure.h"
#include "stages/verdict.h"

#include <nlohmann/json_fwd.hpp>

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace vitrine::graph {

/// Whose fault it is: only what lies in the model is remembered against it.
enum class Cause {
  model,    ///< the same bytes fail again
  memory,   ///< of this machine, for what ran at once
  disk,     ///< the gallery's is full
  machine,  ///< the gallery cannot be written
  stopped   ///< the run ended before
};

struct Failure {
  std::string stage, reason, remedy;
  Cause cause = Cause::model;
};

/// How far the published file is from its original, as a client shows both.
struct Measurement {
  MeasureOptions options;
  Difference mean;
  double worst_mse1e4 = 0;
  std::size_t worst_view = 0;
  double coverage = 0;  ///< share of the original's pictures that it covers
};

/// What a trial made of a model.
struct Made {
  std::uint32_t charts = 0, chart_retries = 0;
  float simplify_error = 0, atlas_fill = 0;
  BakeStatistics bake;
  std::uint32_t triangles = 0, vertices = 0;
  struct Bytes {
    std::size_t total = 0, geometry = 0, colour = 0, normal = 0, occlusion = 0, other = 0;
  } bytes;
  std::size_t x3d_bytes = 0;               ///< of the zip, where the options ask for X3DOM
  std::optional<Recipe> recipe;            ///< what the search chose; none where nothing was searched
  int map_quality = 0;                     ///< that its map was coded with
  std::optional<AngleError> normal_angle;  ///< of its normal map, where there is one
};

struct ModelRow : Made {
  std::string input;  ///< path in the archive
  std::string slug, title;
  std::map<std::string, std::string> metadata;
  std::string status =
      "failed";     ///< "done", "failed", "quarantined" (it takes the program down) or "pending" (not reached)
  Failure failure;  ///< of all that are not done
  std::string thumb, poster, series_folder, x3d, x3d_zip,
      certificate;  ///< paths in the gallery, of a finished one; "": not written

  std::map<std::string, std::string> files;  ///< all that were published, by path in the gallery: content hashes
  struct SeriesWritten {
    int frames = 0, rows = 0;
    std::size_t bytes = 0;
  };
  std::optional<SeriesWritten> series_written;  ///< what lies in series_folder
  std::optional<BoundingSphere>
      sphere;  ///< about the original, of a finished one: the measure's and the poster's cameras follow from it

  std::string input_hash;
  io::Dependencies dependencies;
  std::uint64_t input_bytes = 0, memory = 0;  ///< memory: as admitted
  std::uint64_t source_triangles = 0, source_vertices = 0;
  std::uint64_t thinned_triangles = 0;    ///< what clustering left of them; 0: all
  std::optional<double> thinning_mse1e4;  ///< pictures of what it left against those of all, where it was measured
  bool source_coloured = false;
  io::UpAxis up = io::UpAxis::y;  ///< of the original
  Repairs repairs;
  std::vector<std::string> notes;
  std::vector<Trial> trials;  ///< of the search, in order

  std::optional<Measurement> measurement;  ///< none with --no-certificate; neither are these:
  std::vector<SeriesSizes> series;
  std::optional<Verdict> verdict;

  std::vector<std::pair<std::string, double>> seconds;       ///< wall time per stage, in order; waiting excluded
  std::vector<std::pair<std::string, double>> waiting;       ///< wall time before each stage, from admission on
  std::vector<std::pair<std::string, std::uint64_t>> peaks;  ///< most memory of the program while each stage ran, bytes
};

/// One line for people: "error: office/ch_03.obj: segment: …; try …".
std::string describe(ModelRow const& failed);

/// report.json (schema 1). `archive`: its absolute path; `wall_seconds` of the whole run.
nlohmann::ordered_json report_json(std::vector<ModelRow> const& rows, std::string const& archive,
                                   nlohmann::ordered_json const& options, double wall_seconds);

nlohmann::ordered_json repairs_json(Repairs const& repairs);
nlohmann::ordered_json recipe_json(Recipe const& recipe, int map_quality);

/// Keys of a finished model that the report and the certificate share: bytes, mesh, bake and, if measured, measure,
/// series and verdict.
nlohmann::ordered_json outcome_json(ModelRow const& row);

/// report.csv: the same rows, flat. Cells that a spreadsheet would take for a formula are quoted with an apostrophe.
std::string report_csv(std::vector<ModelRow> const& rows);

/// A report's file: indented, invalid UTF-8 replaced, so that any name can stand in it.
std::string to_text(nlohmann::ordered_json const& json);

/// gallery.json (schema 1): what the gallery page shows of each finished model.
nlohmann::ordered_json gallery_json(std::vector<ModelRow> const& rows);

}  // namespace vitrine::graph
