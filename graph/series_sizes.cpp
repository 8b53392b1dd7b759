// SPDX-License-Identifier: Apache-2.0
#include "graph/series_sizes.h"

#include "io/image_codec.h"
#include "stages/error.h"
#include "stages/parallel.h"
#include "stages/series.h"

#include <nlohmann/json.hpp>

#include <string>

namespace vitrine::graph {
namespace {

struct Coding {
  std::string_view name;
  io::ImageQuality quality;
};
constexpr Coding kCodings[] = {{"jpeg90", {io::ImageCodec::jpeg, 90, true, io::Effort::usual}},
                               {"webp80", {io::ImageCodec::webp, 80, false, io::Effort::usual}},
                               {"avif65", {io::ImageCodec::avif, 65, false, io::Effort::usual}}};
constexpr int kCounts[] = {8, 16, 32};

/// The frames of a smaller series among `views` views.
std::vector<std::size_t> every(std::size_t views, int frames) {
  std::vector<std::size_t> chosen;
  for (std::size_t f = 0; f < std::size_t(frames); ++f) chosen.push_back(f * views / std::size_t(frames));
  return chosen;
}

SeriesSize size_of(std::vector<Image> const& views, std::vector<Image> const& decoded,
                   std::vector<std::size_t> const& bytes, int frames) {
  SeriesSize size{frames};
  std::vector<std::size_t> const chosen = every(views.size(), frames);
  std::vector<Showing> own;
  for (std::size_t const f : chosen) own.push_back({f, f}), size.bytes += bytes[f];
  std::vector<Showing> turned =
      nearest_frames(directions(ViewSet::turntable, int(views.size())), directions(ViewSet::turntable, frames));
  for (Showing& showing : turned) showing.frame = chosen[showing.frame];
  size.coding_mse1e4 = mse1e4(views, decoded, own);
  size.turning_mse1e4 = mse1e4(views, decoded, turned);
  return size;
}

SeriesSizes sizes_in(Coding const& coding, std::vector<Image> const& views) {
  std::vector<Image> decoded(views.size());
  std::vector<std::size_t> bytes(views.size());
  parallel_for(views.size(), 1, [&](std::size_t i) {
    io::EncodedImage const coded = io::encode_image(views[i], coding.quality);
    bytes[i] = coded.bytes.size();
    decoded[i] = io::decode_image(coded.bytes, ColourSpace::srgb);
  });
  SeriesSizes result{coding.name, {}};
  for (int const frames : kCounts)
    if (views.size() % std::size_t(frames) == 0) result.sizes.push_back(size_of(views, decoded, bytes, frames));
  return result;
}

}  // namespace

std::vector<SeriesSizes> series_sizes(Reference const& reference) {
  if (reference.options.views != ViewSet::turntable)
    throw Error(ErrorKind::invalid_input, "a series of pictures is compared over views that are no turntable",
                "measure with --views turntable");
  std::vector<Image> views(reference.pictures.size());
  parallel_for(views.size(), 1, [&](std::size_t i) { views[i] = opaque(reference.pictures[i]); });
  std::vector<SeriesSizes> all;
  for (Coding const& coding : kCodings) all.push_back(sizes_in(coding, views));
  return all;
}

nlohmann::ordered_json to_json(std::vector<SeriesSizes> const& series) {
  nlohmann::ordered_json out = nlohmann::ordered_json::object();
  for (SeriesSizes const& coding : series) {
    nlohmann::ordered_json& counts = out[std::string(coding.codec)] = nlohmann::ordered_json::object();
    for (SeriesSize const& size : coding.sizes)
      counts[std::to_string(size.frames)] = {
          {"bytes", size.bytes}, {"codingMse1e4", size.coding_mse1e4}, {"turningMse1e4", size.turning_mse1e4}};
  }
  return out;
}

}  // namespace vitrine::graph
