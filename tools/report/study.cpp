// SPDX-License-Identifier: Apache-2.0
#include "tools/report/study.h"

#include "graph/preset.h"

#include <utility>

namespace vitrine::report {
namespace {

constexpr int kCeilings[] = {4, 8, 16, 32};

Setting ceiling(int kilobytes) {
  Setting own{"own-" + std::to_string(kilobytes), false, kilobytes, {}};
  own.options.fit.max_kb = kilobytes;
  return own;
}

/// Originals are read and measured as the gallery's.
std::vector<Setting> as_measured(std::vector<Setting> settings, graph::ModelOptions const& gallery) {
  for (Setting& setting : settings) {
    setting.options.read = gallery.read;
    setting.options.publish.viewport = gallery.publish.viewport;
  }
  return settings;
}

}  // namespace

std::vector<Setting> settings(std::vector<int> const& textures, graph::ModelOptions const& gallery) {
  std::vector<Setting> out;
  for (int texture : textures) {
    Setting paper{"paper-" + std::to_string(texture), true, texture, graph::with(graph::Preset::paper, {})};
    paper.options.pack.texture = texture;
    out.push_back(std::move(paper));
  }
  for (int kilobytes : kCeilings) out.push_back(ceiling(kilobytes));
  return as_measured(std::move(out), gallery);
}

std::vector<Setting> ablation_settings(graph::ModelOptions const& gallery) {
  std::vector<Setting> out;
  for (std::size_t choice = 0; choice < EnumNames<Choice>::names.size(); ++choice) {
    Setting setting = ceiling(int(FitOptions{}.max_kb));
    setting.options.fit.without = Choice(choice);
    if (setting.options.fit.without != Choice::none)
      setting.name = "without-" + std::string(EnumNames<Choice>::names[choice]);
    out.push_back(std::move(setting));
  }
  return as_measured(std::move(out), gallery);
}

std::vector<Trial const*> paper_trials(Study const& study) {
  std::vector<Trial const*> out;
  for (Trial const& trial : study.trials)
    if (trial.setting.paper) out.push_back(&trial);
  return out;
}

Values paper_values(Study const& study, double (*figure)(Thumbnail const&)) {
  Values values(study.gallery.models.size());
  for (Trial const* trial : paper_trials(study))
    for (std::size_t m = 0; m < values.size(); ++m) {
      auto const& thumbnail = trial->thumbnails[m];
      values[m].push_back(thumbnail ? std::optional(figure(*thumbnail)) : std::nullopt);
    }
  return values;
}

}  // namespace vitrine::report
