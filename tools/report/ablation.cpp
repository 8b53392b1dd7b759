// SPDX-License-Identifier: Apache-2.0
#include "tools/report/ablation.h"

#include "tools/report/statistics.h"

#include <fmt/format.h>

namespace vitrine::report {
namespace {

/// A search without a choice against the whole one.
struct Loss {
  std::vector<double> ratios;  ///< of errors, of the models that changed
  double similarity = 0;       ///< sum of what SSIM lost
  double most = 1;
  std::string model;  ///< whose error grows most
  std::size_t models = 0;
};

Loss loss(Study const& study, Trial const& whole, Trial const& without) {
  Loss out;
  for (std::size_t m = 0; m < study.gallery.models.size(); ++m) {
    auto const &a = whole.thumbnails[m], &b = without.thumbnails[m];
    if (!a || !b || !(a->mse1e4 > 0)) continue;
    double const ratio = b->mse1e4 / a->mse1e4;
    ++out.models;
    out.similarity += a->ssim - b->ssim;
    if (ratio != 1) out.ratios.push_back(ratio);
    if (ratio > out.most) out.most = ratio, out.model = study.gallery.models[m].title;
  }
  return out;
}

/// Of all models, those that did not change included.
double mean_ratio(Loss const& loss) {
  std::vector<double> ratios = loss.ratios;
  ratios.resize(loss.models, 1);
  return geometric_mean(ratios);
}

}  // namespace

Table ablation(Study const& study) {
  Trial const& whole = study.ablation.front();
  Table table{
      "ablation",
      fmt::format("What each choice of the search is worth, at {} KB", whole.setting.size),
      {"without", "error, times", "SSIM lost", "models changed", "their error, times", "most: model", "most: times"},
      {}};
  for (std::size_t i = 1; i < study.ablation.size(); ++i) {
    Loss const found = loss(study, whole, study.ablation[i]);
    if (found.models == 0) continue;
    Choice const choice = study.ablation[i].setting.options.fit.without;
    table.rows.push_back({Cell(std::string(EnumNames<Choice>::names[std::size_t(choice)])), Cell(mean_ratio(found), 3),
                          Cell(found.similarity / double(found.models), 4), Cell(double(found.ratios.size()), 0),
                          found.ratios.empty() ? Cell() : Cell(geometric_mean(found.ratios), 3), Cell(found.model),
                          found.model.empty() ? Cell() : Cell(found.most, 2)});
  }
  return table;
}

}  // namespace vitrine::report
