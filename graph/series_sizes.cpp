// SPDX-License-Identifier: Apache-2.0
#include "graph/series_sizes.h"

#include "graph/series_coding.h"
#include "stages/error.h"
#include "stages/series.h"

#include <nlohmann/json.hpp>

#include <string>

namespace vitrine::graph {
namespace {

constexpr int kCounts[] = {8, 16, 32};

/// The frames of a smaller series among `views` views.
std::vector<std::size_t> every(std::size_t views, int frames) {
  std::vector<std::size_t> chosen;
  for (std::size_t f = 0; f < std::size_t(frames); ++f) chosen.push_back(f * views / std::size_t(frames));
  return chosen;
}

SeriesSize size_of(std::vector<Image> const& views, CodedFrames const& coded, int frames) {
  SeriesSize size{frames};
  std::vector<std::size_t> const chosen = every(views.size(), frames);
  std::vector<Showing> own;
  for (std::size_t const f : chosen) own.push_back({f, f}), size.bytes += coded.files[f].size();
  std::vector<Showing> turned =
      nearest_frames(directions(ViewSet::turntable, int(views.size())), series_directions(frames, 1));
  for (Showing& showing : turned) showing.frame = chosen[showing.frame];
  size.coding_mse1e4 = mse1e4(views, coded.decoded, own);
  size.turning_mse1e4 = mse1e4(views, coded.decoded, turned);
  return size;
}

}  // namespace

std::vector<SeriesSizes> series_sizes(Reference const& reference) {
  if (reference.options.views != ViewSet::turntable)
    throw Error(ErrorKind::invalid_input, "a series of pictures is compared over views that are no turntable",
                "measure with --views turntable");
  std::vector<Image> const views = without_alpha(reference.pictures);
  std::vector<SeriesSizes> all;
  for (SeriesCodec const codec : {SeriesCodec::jpeg, SeriesCodec::webp, SeriesCodec::avif}) {
    CodedFrames const coded = code_frames(views, coding(codec, usual_quality(codec)));
    all.push_back({name_of(codec) + std::to_string(usual_quality(codec)), {}});
    for (int const frames : kCounts)
      if (views.size() % std::size_t(frames) == 0) all.back().sizes.push_back(size_of(views, coded, frames));
  }
  return all;
}

nlohmann::ordered_json to_json(std::vector<SeriesSizes> const& series) {
  nlohmann::ordered_json out = nlohmann::ordered_json::object();
  for (SeriesSizes const& coded : series) {
    nlohmann::ordered_json& counts = out[coded.codec] = nlohmann::ordered_json::object();
    for (SeriesSize const& size : coded.sizes)
      counts[std::to_string(size.frames)] = {
          {"bytes", size.bytes}, {"codingMse1e4", size.coding_mse1e4}, {"turningMse1e4", size.turning_mse1e4}};
  }
  return out;
}

std::vector<RivalSeries> rivals(std::vector<SeriesSizes> const& series) {
  std::vector<RivalSeries> out;
  for (SeriesSizes const& coded : series)
    for (SeriesSize const& size : coded.sizes)
      out.push_back({coded.codec, size.frames, size.bytes, size.turning_mse1e4});
  return out;
}

}  // namespace vitrine::graph
