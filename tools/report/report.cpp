// SPDX-License-Identifier: Apache-2.0
#include "tools/report/report.h"

#include "graph/options_json.h"
#include "tools/printable.h"
#include "tools/report/pictures.h"
#include "tools/report/trials.h"

#include <fmt/format.h>

#include <algorithm>

namespace vitrine::report {

int report(ReportCommand const& command) {
  Gallery gallery = read_gallery(command.gallery);
  if (!command.archive.empty()) gallery.archive = command.archive;
  io::Archive const archive = originals(gallery);
  std::vector<int> textures = command.textures;
  std::sort(textures.begin(), textures.end());
  textures.erase(std::unique(textures.begin(), textures.end()), textures.end());
  graph::ModelOptions const made_with = graph::options_from_json(gallery.models.front().certificate.at("options"));
  std::vector<Trial> trials = run_trials(gallery, archive, settings(textures, made_with), command.run);
  std::vector<Trial> ablation;
  if (command.ablation) ablation = run_trials(gallery, archive, ablation_settings(made_with), command.run);
  Study const study{std::move(gallery), std::move(trials), std::move(ablation)};
  publish_page(study, publish_pictures(study, archive));
  fmt::print("{} models: {}\n", study.gallery.models.size(),
             tools::printable((command.gallery / "paper.html").string()));
  return 0;
}

}  // namespace vitrine::report
