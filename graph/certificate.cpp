// SPDX-License-Identifier: Apache-2.0
#include "graph/certificate.h"

#include "graph/options_json.h"
#include "graph/settings.h"
#include "io/codec_versions.h"
#include "io/dependencies.h"

#include <cmath>

namespace vitrine::graph {
namespace {

using json = nlohmann::ordered_json;

json input_json(ModelRow const& row) {
  json out = {{"path", row.input},
              {"hash", row.input_hash},
              {"bytes", row.input_bytes},
              {"triangles", row.source_triangles},
              {"vertices", row.source_vertices},
              {"coloured", row.source_coloured},
              {"up", row.up == io::UpAxis::z ? "z" : "y"}};
  json dependencies = json::array();
  for (auto const& [name, hash] : row.dependencies)
    dependencies.push_back({{"path", name}, {"hash", hash.empty() ? json() : json(hash)}});
  out["dependencies"] = std::move(dependencies);
  return out;
}

/// Each trial of the search: what was chosen, what it cost, how far it was off where the search looked.
json trials_json(std::vector<Trial> const& trials) {
  json out = json::array();
  for (Trial const& trial : trials) {
    json one = recipe_json(trial.recipe, trial.map_quality);
    if (std::isinf(trial.error))
      one["failed"] = true;
    else
      one.update(
          {{"bytes", trial.bytes}, {"mapBytes", trial.map_bytes}, {"mse1e4", trial.error}, {"score", trial.score}});
    out.push_back(std::move(one));
  }
  return out;
}

}  // namespace

json program_json() { return {{"name", "vitrine"}, {"version", VITRINE_VERSION}}; }

json certificate_json(ModelRow const& row, ModelOptions const& options) {
  json out = {{"schema", 1},
              {"title", row.title},
              {"input", input_json(row)},
              {"program", program_json()},
              {"build", build_id()},
              {"codecs", io::codec_versions()},
              {"options", options_json(options)},
              {"settings", settings_hash(options, row.title, row.up)}};
  out.update(outcome_json(row));
  if (row.recipe) out["search"]["trials"] = trials_json(row.trials);
  out["repairs"] = repairs_json(row.repairs);
  out["notes"] = row.notes;
  out["files"] = row.files;
  return out;
}

std::string seal_of(json certificate) {
  certificate.erase("seal");
  return io::content_hash(to_text(certificate));
}

std::string certificate_text(ModelRow const& row, ModelOptions const& options) {
  json certificate = certificate_json(row, options);
  certificate["seal"] = seal_of(certificate);
  return to_text(certificate);
}

}  // namespace vitrine::graph
