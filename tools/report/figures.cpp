// SPDX-License-Identifier: Apache-2.0
#include "tools/report/figures.h"

#include "tools/report/paper_tables.h"

#include <fmt/format.h>

#include <algorithm>

namespace vitrine::report {
namespace {

constexpr char const* kAlone = "this gallery's thumbnail";

std::vector<std::string> const kParts{"geometry", "colour", "normals", "occlusion", "other"};

std::vector<double> parts(Thumbnail const& t) {
  std::vector<double> out;
  for (std::size_t bytes : {t.geometry, t.colour, t.normal, t.occlusion, t.other}) out.push_back(double(bytes) / 1000);
  return out;
}

StackedBar mean_bar(Trial const& trial) {
  StackedBar bar{fmt::format("{0} x {0}", trial.setting.size), std::vector<double>(kParts.size(), 0.0)};
  double const made =
      double(std::count_if(trial.thumbnails.begin(), trial.thumbnails.end(), [](auto const& t) { return bool(t); }));
  for (auto const& thumbnail : trial.thumbnails) {
    if (!thumbnail) continue;
    std::vector<double> const own = parts(*thumbnail);
    for (std::size_t i = 0; i < own.size(); ++i) bar.parts[i] += own[i] / made;
  }
  return bar;
}

CurvePoint point(Thumbnail const& thumbnail, std::string label) {
  return {double(thumbnail.delivered) / 1000, thumbnail.mse1e4, std::move(label)};
}

/// One curve of thumbnails and one for each coding of the series, as `pick` takes them from a study.
std::vector<Curve> named_curves(std::vector<RivalSeries> const& series) {
  std::vector<Curve> curves{{"Vitrine, ceiling in KB", 0, {}}, {"the paper's choices, texels", 1, {}}, {kAlone, 5, {}}};
  for (RivalSeries const& s : series) {
    std::string const name = codec_name(s.codec) + " series, views";
    if (std::none_of(curves.begin(), curves.end(), [&](Curve const& c) { return c.name == name; }))
      curves.push_back({name, int(curves.size()) - 1, {}});
  }
  return curves;
}

Curve& series_curve(std::vector<Curve>& curves, std::string_view codec) {
  std::string const name = codec_name(codec) + " series, views";
  return *std::find_if(curves.begin(), curves.end(), [&](Curve const& c) { return c.name == name; });
}

/// Models that every setting could make.
std::vector<std::size_t> common_models(Study const& study) {
  std::vector<std::size_t> out;
  for (std::size_t m = 0; m < study.gallery.models.size(); ++m)
    if (std::all_of(study.trials.begin(), study.trials.end(), [&](Trial const& t) { return bool(t.thumbnails[m]); }))
      out.push_back(m);
  return out;
}

/// The geometric mean of points.
class MeanPoint {
 public:
  void add(double bytes, double mse1e4) { kilobytes_.push_back(bytes / 1000), errors_.push_back(mse1e4); }
  CurvePoint point(std::string text) const {
    return {geometric_mean(kilobytes_), geometric_mean(errors_), std::move(text)};
  }

 private:
  std::vector<double> kilobytes_, errors_;
};

Svg draw(ChartText const& text, std::vector<Curve> const& curves) {
  return log_curves(text, "KB (1000 bytes)", "mean square error x 10^4", curves);
}

}  // namespace

Svg figure4(Study const& study) {
  std::vector<StackedBar> bars;
  for (Model const& model : study.gallery.models) bars.push_back({model.title, parts(model.thumbnail)});
  return stacked_bars(
      {"figure4", "Figure 4. Bytes of this gallery's thumbnails",
       "One bar for each model, its bytes in KB by geometry, colour map, normal map, occlusion map and the rest."},
      "KB (1000 bytes)", kParts, bars);
}

Svg figure4_by_texture(Study const& study) {
  std::vector<StackedBar> bars;
  for (Trial const* trial : paper_trials(study)) bars.push_back(mean_bar(*trial));
  return stacked_bars({"figure4texture", "Figure 4, continued. Mean bytes with the paper's choices, by texture size",
                       "One bar for each texture size: mean KB over the models by geometry, colour map, normal map, "
                       "occlusion map and the rest."},
                      "KB (1000 bytes)", kParts, bars);
}

Svg curves_of_all(Study const& study) {
  std::vector<std::size_t> const models = common_models(study);
  std::vector<Model> const& all = study.gallery.models;
  std::vector<RivalSeries> const series = all.front().thumbnail.series;
  std::vector<Curve> curves = named_curves(series);
  for (Trial const& trial : study.trials) {
    MeanPoint mean;
    for (std::size_t m : models) mean.add(double(trial.thumbnails[m]->delivered), trial.thumbnails[m]->mse1e4);
    curves[trial.setting.paper].points.push_back(mean.point(std::to_string(trial.setting.size)));
  }
  MeanPoint own;
  for (std::size_t m : models) own.add(double(all[m].thumbnail.bytes), all[m].thumbnail.mse1e4);
  curves[2].points.push_back(own.point(""));
  for (std::size_t i = 0; i < series.size(); ++i) {
    MeanPoint mean;
    for (std::size_t m : models) {
      std::vector<RivalSeries> const& its = all[m].thumbnail.series;
      if (i < its.size()) mean.add(double(its[i].bytes), its[i].turning_mse1e4);
    }
    series_curve(curves, series[i].codec).points.push_back(mean.point(std::to_string(series[i].frames)));
  }
  return draw(
      {"curves", fmt::format("Error over bytes, geometric means of {} models", models.size()),
       "Thumbnails at several settings, and image series of 8, 16 and 32 views with their turning error. Lower and "
       "further left is better."},
      curves);
}

Svg curves_of(Study const& study, std::size_t m) {
  Model const& model = study.gallery.models[m];
  std::vector<Curve> curves = named_curves(model.thumbnail.series);
  for (Trial const& trial : study.trials)
    if (auto const& thumbnail = trial.thumbnails[m])
      curves[trial.setting.paper].points.push_back(point(*thumbnail, std::to_string(trial.setting.size)));
  curves[2].points.push_back(point(model.thumbnail, ""));
  for (RivalSeries const& s : model.thumbnail.series)
    series_curve(curves, s.codec)
        .points.push_back({double(s.bytes) / 1000, s.turning_mse1e4, std::to_string(s.frames)});
  return draw(
      {fmt::format("curves{}", m), "Error over bytes: " + model.title,
       "Thumbnails at several settings, and image series with their turning error. Lower and further left is better."},
      curves);
}

}  // namespace vitrine::report
