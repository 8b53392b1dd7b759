// SPDX-License-Identifier: Apache-2.0
#include "tools/report/words.h"

#include "tools/report/paper_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace vitrine::report {
namespace {

using Sentences = std::vector<std::string>;

double error(Thumbnail const& thumbnail) { return thumbnail.mse1e4; }

double normal_share(Thumbnail const& thumbnail) { return 100 * double(thumbnail.normal) / double(thumbnail.bytes); }

std::string models(std::size_t count) { return count == 1 ? "1 model" : fmt::format("{} models", count); }

// ---- 3D or series
// -----------------------------------------------------------------------------------------------------

std::string say_verdict(Study const& study) {
  std::vector<Model> const& all = study.gallery.models;
  auto const wins = [](Model const& m) {
    return verdict(m.thumbnail.bytes, m.thumbnail.mse1e4, m.thumbnail.series).thumbnail_wins;
  };
  std::size_t const won = std::size_t(std::count_if(all.begin(), all.end(), wins));
  return fmt::format(
      "At the same quality the 3D thumbnail takes fewer bytes than any image series for {} of {}. Same quality: the "
      "series' "
      "turning error (the nearest decoded frame against the true view, over the whole turntable) is not above the "
      "thumbnail's error.",
      won, models(all.size()));
}

void say_bytes_alone(Study const& study, Sentences& out) {
  std::size_t compared = 0, won = 0;
  for (Model const& model : study.gallery.models) {
    std::size_t const eight = series_bytes(model.thumbnail, "webp80", 8);
    compared += eight > 0;
    won += model.thumbnail.bytes < eight;
  }
  if (compared > 0)
    out.push_back(
        fmt::format("By bytes alone, whatever the quality, the thumbnail is smaller than 8 views as WebP of quality 80 "
                    "for {} of {}.",
                    won, models(compared)));
}

// ---- Error by model and texture size
// ----------------------------------------------------------------------------------

void say_variance(Study const& study, Sentences& out) {
  std::vector<std::vector<double>> table = complete_rows(paper_values(study, error));
  auto const plain = variance_shares(table);
  if (!plain) return;
  std::string text = fmt::format(
      "With the paper's choices the model explains {:.1f} % of the variance of the error and the texture size {:.1f} "
      "%; {:.1f} % "
      "are left to models that answer to the texture size in their own way (two-way analysis of variance, {}, {} "
      "texture sizes).",
      100 * plain->rows, 100 * plain->columns, 100 * plain->rest, models(table.size()), table[0].size());
  bool positive = true;
  for (auto& row : table)
    for (double& value : row) positive = positive && value > 0, value = std::log(value);
  if (auto const relative = positive ? variance_shares(table) : std::nullopt)
    text += fmt::format(
        " Of the error's logarithm, where one bad model does not outweigh all others, these are {:.1f}, {:.1f} and "
        "{:.1f} %.",
        100 * relative->rows, 100 * relative->columns, 100 * relative->rest);
  out.push_back(std::move(text));
}

void say_exceptions(Study const& study, Sentences& out) {
  Values const values = paper_values(study, error);
  std::vector<Trial const*> const trials = paper_trials(study);
  if (trials.size() < 2) return;
  std::vector<Rise> const found = rises(values);
  if (found.empty()) {
    out.push_back("The error falls, or stays, with each larger texture for every model.");
    return;
  }
  std::string text = "The error falls with each larger texture, but for:";
  for (Rise const& rise : found)
    text += fmt::format("{} {} from {} to {} texels ({:.2f} to {:.2f})", &rise == &found[0] ? "" : ";",
                        study.gallery.models[rise.row].title, trials[rise.column - 1]->setting.size,
                        trials[rise.column]->setting.size, *values[rise.row][rise.column - 1],
                        *values[rise.row][rise.column]);
  out.push_back(text + ".");
}

// ---- Bytes
// ------------------------------------------------------------------------------------------------------------

/// "45 % of the bytes (36 to 52 %)": the mean and the range.
std::string shares_text(std::vector<double> const& shares, std::string_view of) {
  double sum = 0;
  for (double share : shares) sum += share;
  auto const [least, most] = std::minmax_element(shares.begin(), shares.end());
  return fmt::format("{:.0f} %{} ({:.0f} to {:.0f} %)", sum / double(shares.size()), of, *least, *most);
}

void say_normal_maps(Study const& study, Sentences& out) {
  std::string text;
  for (Trial const* trial : paper_trials(study)) {
    std::vector<double> shares;
    for (auto const& thumbnail : trial->thumbnails)
      if (thumbnail && thumbnail->normal > 0) shares.push_back(normal_share(*thumbnail));
    if (!shares.empty())
      text += fmt::format("{}{} at {} texels", text.empty() ? "" : ", ",
                          shares_text(shares, text.empty() ? " of the bytes" : ""), trial->setting.size);
  }
  if (!text.empty()) out.push_back("With the paper's choices the normal map takes on average " + text + ".");
  std::vector<double> shares;
  for (Model const& model : study.gallery.models)
    if (model.thumbnail.normal > 0) shares.push_back(normal_share(model.thumbnail));
  if (!shares.empty())
    out.push_back(fmt::format("In this gallery's thumbnails, where there is a normal map ({}), it takes on average {}.",
                              models(shares.size()), shares_text(shares, " of the bytes")));
}

void say_coverage(Study const& study, Sentences& out) {
  std::string text;
  for (std::string const codec : {"jpeg90", "webp80"}) {
    std::vector<double> coverage, bytes;
    for (Model const& model : study.gallery.models)
      if (std::size_t const size = series_bytes(model.thumbnail, codec, 8))
        coverage.push_back(model.thumbnail.coverage), bytes.push_back(double(size));
    if (auto const r = correlation(coverage, bytes))
      text += fmt::format("{}{:.2f} as {}", text.empty() ? "" : ", ", *r, codec_name(codec));
  }
  if (!text.empty())
    out.push_back("Screen coverage and bytes of a series of 8 views go together with a correlation of " + text + ".");
}

}  // namespace

std::vector<std::string> findings(Study const& study) {
  Sentences out{say_verdict(study)};
  say_bytes_alone(study, out);
  say_variance(study, out);
  say_exceptions(study, out);
  say_normal_maps(study, out);
  say_coverage(study, out);
  return out;
}

}  // namespace vitrine::report
