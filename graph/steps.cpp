// SPDX-License-Identifier: Apache-2.0
#include "graph/steps.h"

#include "graph/certificate.h"
#include "io/image_codec.h"
#include "io/publish.h"
#include <algorithm>
#include <cctype>
#include <string>
#include <utility>

namespace vitrine::graph {
namespace {

namespace fs = std::filesystem;

constexpr int kPosterQuality = 80;

std::string ending(std::string const& path) {
  std::string text = fs::path(path).extension().string();
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return text;
}

/// Decoded and not repaired: what a client cannot draw is to be seen here.
SurveyedModel decode(EncodedThumbnail const& thumbnail) {
  io::Resolve const nothing = [](std::string_view) { return std::nullopt; };
  return survey(std::make_shared<SourceModel const>(io::read_model(".glb", io::own(thumbnail.glb), nothing)));
}

Measurement measurement(Reference const& reference, Comparison const& comparison) {
  return {reference.options, comparison.mean, comparison.views[comparison.worst].mse1e4, comparison.worst,
          coverage(reference.pictures)};
}

std::vector<RivalSeries> rivals(std::vector<SeriesSizes> const& series) {
  std::vector<RivalSeries> out;
  for (SeriesSizes const& coded : series)
    for (SeriesSize const& size : coded.sizes)
      out.push_back({std::string(coded.codec), size.frames, size.bytes, size.turning_mse1e4});
  return out;
}

/// What the certificate says of a thumbnail drawn from the reference's cameras.
void certify(Reference const& reference, std::vector<Image> const& drawn, ModelRow& row) {
  row.measurement = measurement(reference, compare(reference.pictures, drawn));
  row.series = series_sizes(reference);
  row.verdict = verdict(row.bytes.total, row.measurement->mean.mse1e4, rivals(row.series));
}

std::vector<std::byte> poster_jpeg(Image const& picture) {
  return io::encode_image(opaque(picture), {io::ImageCodec::jpeg, kPosterQuality}).bytes;
}

}  // namespace

CleanModel load_model(Job& job, io::ReadOptions const& options) {
  io::ArchiveEntry const& entry = *job.entry;
  ModelRow& row = job.row;
  io::Blob const file = io::map_file(entry.file);
  row.input_hash = io::content_hash(file.bytes);
  io::Resolve const resolve = io::recording(io::resolve_in(entry.file.parent_path()), row.dependencies);
  SourceModel source = io::read_model(ending(entry.path), file, resolve, options);
  row.up = entry.up;
  if (entry.up == io::UpAxis::z) io::turn_z_up(source);
  row.source_triangles = source.mesh.triangles.size();
  row.source_vertices = source.mesh.positions.size();
  row.source_coloured = has_colour(source);
  row.notes = source.notes;
  CleanModel cleaned = clean(std::move(source));
  row.repairs = cleaned.repairs;
  return cleaned;
}

Original survey_model(In<CleanModel> const& clean, PublishOptions const& options) {
  SurveyedModel model = survey(std::shared_ptr<SourceModel const>(clean, &clean->model));
  MeasureOptions measure;
  measure.size = options.viewport;
  if (!options.certificate) measure.count = 1;  // the poster's
  Reference seen = options.certificate ? reference(model, measure) : viewpoints(model, measure);
  return {std::move(model), std::move(seen)};
}

Against<SimplifiedMesh> simplify_model(In<Original> const& original, SimplifyOptions const& options, Job& job) {
  SimplifiedMesh light = simplify(weld(*original->model.model), options);
  job.row.simplify_error = light.error;
  return {original, std::move(light)};
}

Against<Atlas> pack_charts(In<Against<FlatCharts>> const& flat, PackOptions const& options, Job& job) {
  Atlas atlas = pack(flat->light, options);
  job.row.charts = atlas.charts;
  job.row.chart_retries = flat->light.retries;
  job.row.atlas_fill = atlas.fill;
  return {flat->original, std::move(atlas)};
}

Against<BakedModel> bake_maps(In<Against<Atlas>> const& packed, ModelOptions const& options, Job& job) {
  BakedModel baked = bake(quantize(packed->light, options.quantize), packed->original->model, options.bake);
  job.row.bake = baked.statistics;
  return {packed->original, std::move(baked)};
}

Against<EncodedThumbnail> encode_thumbnail(In<Against<BakedModel>> const& baked, io::EncodeOptions const& options,
                                           Job& job) {
  EncodedThumbnail thumbnail = io::encode(baked->light, job.row.title, options);
  ModelRow& row = job.row;
  row.triangles = thumbnail.triangles;
  row.vertices = thumbnail.vertices;
  row.bytes = {thumbnail.glb.size(), thumbnail.geometry,  thumbnail.colour,
               thumbnail.normal,     thumbnail.occlusion, thumbnail.other};
  return {baked->original, std::move(thumbnail)};
}

Finished measure_thumbnail(In<Against<EncodedThumbnail>> const& encoded, Job& job) {
  Reference const& reference = encoded->original->reference;
  std::vector<Image> drawn = pictures(decode(encoded->light), reference);
  if (!reference.pictures.empty()) certify(reference, drawn, job.row);
  return {encoded->light, std::move(drawn.front())};
}

void publish_model(Finished const& finished, ModelOptions const& options, fs::path const& gallery, Job& job) {
  ModelRow& row = job.row;
  fs::path const folder = fs::path("models") / row.slug;
  row.thumb = folder / "thumb.glb";
  row.poster = folder / "poster.jpg";
  io::publish_file(gallery / row.thumb, finished.thumbnail.glb);
  io::publish_file(gallery / row.poster, poster_jpeg(finished.poster));
  if (row.measurement) {
    row.certificate = folder / "certificate.json";
    io::publish_file(gallery / row.certificate, to_text(certificate_json(row, options)));
  }
  row.status = "done";
}

}  // namespace vitrine::graph
