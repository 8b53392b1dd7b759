// SPDX-License-Identifier: Apache-2.0
#include "graph/record.h"

#include "graph/bounded_json.h"

namespace vitrine::graph {

template <class T>
struct StrictSerializer<std::optional<T>> {
  static void to_json(StrictJson& out, std::optional<T> const& value) {
    out = value ? StrictJson(*value) : StrictJson();
  }
  static void from_json(StrictJson const& in, std::optional<T>& value) {
    value.reset();
    if (in.is_null()) return;
    T made{};  // no get<T>: clang 14 takes a nested class with initialisers for not default constructible
    in.get_to(made);
    value = std::move(made);
  }
};

}  // namespace vitrine::graph

namespace vitrine::io {
VITRINE_JSON_MEMBERS(Stamp, bytes, inode, modified, changed)
}  // namespace vitrine::io

namespace vitrine {
VITRINE_JSON_MEMBERS(Recipe, triangles, shading, painting, colour_weight, fitted, position_bits, normal_bits,
                     colour_bits, smoothing, unfolding, texture, map_quality, ceiling, avif, full_chroma, polished)
VITRINE_JSON_MEMBERS(Trial, recipe, bytes, map_bytes, map_quality, error, score)
VITRINE_JSON_MEMBERS(BakeStatistics, texels, samples, misses)
VITRINE_JSON_MEMBERS(AngleError, p50, p99)
VITRINE_JSON_MEMBERS(Repairs, nonfinite_vertices, degenerate_faces, duplicate_faces, repaired_normals, flipped_faces)
VITRINE_JSON_MEMBERS(Difference, mse1e4, foreground_mse1e4, psnr, ssim, foreground_ssim, iou)
VITRINE_JSON_MEMBERS(MeasureOptions, views, count, size, light, supersample, occlusion)
VITRINE_JSON_MEMBERS(RivalSeries, codec, frames, bytes, turning_mse1e4)
VITRINE_JSON_MEMBERS(Verdict, thumbnail_wins, rival)

void to_json(graph::StrictJson& out, BoundingSphere const& sphere) {
  out = {sphere.centre.x, sphere.centre.y, sphere.centre.z, sphere.radius};
}
void from_json(graph::StrictJson const& in, BoundingSphere& sphere) {
  sphere = {{in.at(0), in.at(1), in.at(2)}, in.at(3)};
}
}  // namespace vitrine

namespace vitrine::graph {
namespace {

constexpr int kVersion = 2;

}  // namespace

using Bytes = Made::Bytes;
VITRINE_JSON_MEMBERS(Bytes, total, geometry, colour, normal, occlusion, other)
VITRINE_JSON_MEMBERS(Failure, stage, reason, remedy, cause)
VITRINE_JSON_MEMBERS(Measurement, options, mean, worst_mse1e4, worst_view, coverage)
VITRINE_JSON_MEMBERS(SeriesSize, frames, bytes, coding_mse1e4, turning_mse1e4)
VITRINE_JSON_MEMBERS(SeriesSizes, codec, sizes)
using SeriesWritten = ModelRow::SeriesWritten;
VITRINE_JSON_MEMBERS(SeriesWritten, frames, rows, bytes)
VITRINE_JSON_MEMBERS(ModelRow, series_written, sphere, thinned_triangles, thinning_mse1e4, waiting, peaks, charts,
                     chart_retries, simplify_error, atlas_fill, bake, triangles, vertices, bytes, x3d_bytes, recipe,
                     map_quality, normal_angle, input, slug, title, metadata, status, failure, thumb, poster,
                     series_folder, x3d, x3d_zip, certificate, files, input_hash, dependencies, input_bytes, memory,
                     source_triangles, source_vertices, source_coloured, up, repairs, notes, trials, measurement,
                     series, verdict, seconds)
VITRINE_JSON_MEMBERS(Record, row, settings, stamps, since, evidence)

std::string to_bytes(Record const& record) {
  StrictJson json = record;
  json["version"] = kVersion;
  std::string bytes;
  StrictJson::to_cbor(json, bytes);
  return bytes;
}

std::optional<Record> record_from(std::string const& bytes) try {
  std::optional<StrictJson> const json = bounded_cbor(bytes);
  if (!json || json->at("version") != kVersion) return {};
  return json->get<Record>();
} catch (StrictJson::exception const&) {
  return {};
}

}  // namespace vitrine::graph
