// SPDX-License-Identifier: Apache-2.0
#include "graph/record.h"

#include "graph/bounded_json.h"

#include <nlohmann/json.hpp>

namespace nlohmann {

template <class T>
struct adl_serializer<std::optional<T>> {
  static void to_json(json& out, std::optional<T> const& value) { out = value ? json(*value) : json(); }
  static void from_json(json const& in, std::optional<T>& value) {
    value.reset();
    if (in.is_null()) return;
    T made{};  // no get<T>: clang 14 takes a nested class with initialisers for not default constructible
    in.get_to(made);
    value = std::move(made);
  }
};

/// As a number; one that stands for nothing is an error.
template <class Enum>
  requires requires { vitrine::EnumNames<Enum>::names; }
struct adl_serializer<Enum> {
  static void to_json(json& out, Enum value) { out = int(value); }
  static void from_json(json const& in, Enum& value) {
    auto const number = in.get<std::int64_t>();
    if (number < 0 || number >= std::int64_t(vitrine::EnumNames<Enum>::names.size()))
      throw json::other_error::create(501, "there is no choice " + in.dump(), &in);
    value = Enum(number);
  }
};

}  // namespace nlohmann

namespace vitrine::io {
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Stamp, bytes, inode, modified, changed)
}  // namespace vitrine::io

namespace vitrine {
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Recipe, triangles, shading, painting, colour_weight, fitted, position_bits,
                                   normal_bits, colour_bits, smoothing, unfolding, texture, map_quality, ceiling, avif)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Trial, recipe, bytes, map_bytes, map_quality, error, score)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(BakeStatistics, texels, samples, misses)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(AngleError, p50, p99)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Repairs, nonfinite_vertices, degenerate_faces, duplicate_faces, repaired_normals,
                                   flipped_faces)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Difference, mse1e4, foreground_mse1e4, psnr, ssim, foreground_ssim, iou)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(MeasureOptions, views, count, size, light, supersample, occlusion)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RivalSeries, codec, frames, bytes, turning_mse1e4)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Verdict, thumbnail_wins, rival)

void to_json(nlohmann::json& out, BoundingSphere const& sphere) {
  out = {sphere.centre.x, sphere.centre.y, sphere.centre.z, sphere.radius};
}
void from_json(nlohmann::json const& in, BoundingSphere& sphere) { sphere = {{in.at(0), in.at(1), in.at(2)}, in.at(3)}; }
}  // namespace vitrine

namespace vitrine::graph {
namespace {

constexpr int kVersion = 2;

}  // namespace

using Bytes = Made::Bytes;
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Bytes, total, geometry, colour, normal, occlusion, other)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Failure, stage, reason, remedy, cause)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Measurement, options, mean, worst_mse1e4, worst_view, coverage)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SeriesSize, frames, bytes, coding_mse1e4, turning_mse1e4)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SeriesSizes, codec, sizes)
using SeriesWritten = ModelRow::SeriesWritten;
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SeriesWritten, frames, rows, bytes)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ModelRow, series_written, sphere, thinned_triangles, thinning_mse1e4, waiting, peaks, charts, chart_retries, simplify_error, atlas_fill, bake, triangles, vertices,
                                   bytes, x3d_bytes, recipe, map_quality, normal_angle, input, slug, title, metadata, status, failure, thumb, poster,
                                   series_folder, x3d, x3d_zip, certificate, files, input_hash, dependencies, input_bytes,
                                   memory, source_triangles, source_vertices, source_coloured, up, repairs, notes, trials,
                                   measurement, series, verdict, seconds)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Record, row, settings, stamps, since, evidence)

std::string to_bytes(Record const& record) {
  nlohmann::json json = record;
  json["version"] = kVersion;
  std::string bytes;
  nlohmann::json::to_cbor(json, bytes);
  return bytes;
}

std::optional<Record> record_from(std::string const& bytes) try {
  std::optional<nlohmann::json> const json = bounded_cbor(bytes);
  if (!json || json->at("version") != kVersion) return {};
  return json->get<Record>();
} catch (nlohmann::json::exception const&) {
  return {};
}

}  // namespace vitrine::graph
