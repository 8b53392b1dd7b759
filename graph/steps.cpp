// SPDX-License-Identifier: Apache-2.0
#include "graph/steps.h"

#include "graph/certificate.h"
#include "graph/model_folder.h"
#include "graph/trial_steps.h"
#include "io/image_codec.h"
#include "stages/clean.h"
#include "stages/cluster.h"
#include "stages/deviation.h"
#include "stages/error.h"
#include "stages/outside.h"
#include "stages/welded_colours.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>
#include <utility>

namespace vitrine::graph {
namespace {

namespace fs = std::filesystem;

constexpr int kPosterQuality = 80;
/// Of the surface, for whatever is fitted to it: with fewer for each triangle, triangles are fitted to chance.
constexpr double kSamplesPerByte = 10;
constexpr double kFewestSamples = 120'000, kMostSamples = 500'000;
/// Atlases of larger originals are those of scans: seams hold too many triangles.
constexpr std::size_t kMostOwnTriangles = 100'000;
constexpr double kColourWeight = 0.02;  ///< of the one coloured progression: the recipe says whether it is used

std::string ending(std::string const& path) {
  std::string text = fs::path(path).extension().string();
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return text;
}

/// With --max-error by what is promised.
std::vector<Judge> judges_of(SurveyedModel const& model, ModelOptions const& options) {
  if (!searches(options)) return {};
  int const viewport = options.publish.viewport;
  if (options.fit.max_error > 0) return {{reference(model, {.size = viewport}), {}}};
  return judges(model, viewport, options.fit.pixel_ratio, options.bake.occlusion);
}

int longer_side(Image const& image) { return std::max(image.width, image.height); }

/// In model units; 0: none.
double deviation_limit(Original const& original, ModelOptions const& options) {
  double const radius = original.reference.sphere.radius;
  double const by_box = options.fit.max_deviation * 2 * original.samples.radius;
  double const by_pixels = options.fit.max_px * pixel_length(radius, options.publish.viewport);
  return by_box > 0 && by_pixels > 0 ? std::min(by_box, by_pixels) : std::max(by_box, by_pixels);
}

/// The coarsest level, to one part in fifty, whose surface lies nowhere farther from the original's.
std::size_t fewest_within(double limit, Progression const& levels, SurfaceSamples const& samples) {
  std::size_t low = 4, high = levels.finest();
  if (deviation(levels.at(high).mesh, samples) > limit)
    throw Error(ErrorKind::no_solution,
                "no level of " + std::to_string(high) + " triangles or fewer keeps to the deviation asked for",
                "raise --max-deviation or --max-px");
  while (high - low > high / 50 + 1) {
    std::size_t const middle = low + (high - low) / 2;
    (deviation(levels.at(middle).mesh, samples) > limit ? low : high) = middle;
  }
  return high;
}

Measurement measurement(Reference const& reference, Comparison const& comparison) {
  return {reference.options, comparison.mean, comparison.views[comparison.worst].mse1e4, comparison.worst,
          coverage(reference.pictures)};
}

/// How far pictures of a thinned scan are from those of the whole: MSE x 10^4 over some views.
double thinning_error(SourceModel whole, SourceModel const& thin, int size) {
  constexpr int views = 4;
  if (whole.normals.empty()) whole.normals = smooth_normals(whole.mesh, merged_places(whole.mesh));
  Reference const all =
      reference(survey(std::make_shared<SourceModel const>(std::move(whole))), {.count = views, .size = size});
  SurveyedModel const left = survey(std::shared_ptr<SourceModel const>(std::shared_ptr<void>(), &thin));
  return compare(all.pictures, pictures(left, all)).mean.mse1e4;
}

/// Who limits how far the surface may lie from the original's means all of it; occlusion is traced on the whole;
/// textures would be held twice, which admission does not know.
bool shows_outside_only(SurveyedModel const& whole, ModelOptions const& options) {
  return searches(options) && options.fit.max_deviation == 0 && options.fit.max_px == 0 &&
         options.bake.occlusion == Occlusion::none && whole.surface.alpha() == AlphaMode::opaque &&
         whole.model->images.empty();
}

std::optional<SurveyedModel> outer_model(SurveyedModel const& whole, ModelRow& row) {
  std::optional<SourceModel> outer = outside(*whole.model);
  if (!outer) return {};
  std::size_t const all = whole.model->mesh.triangles.size(), left = outer->mesh.triangles.size();
  row.notes.push_back(std::to_string(all - left) + " of " + std::to_string(all) +
                      " triangles are hidden within and were left out");
  return survey(std::make_shared<SourceModel const>(std::move(*outer)));
}

std::vector<std::byte> poster_jpeg(Image const& picture) {
  return io::encode_image(opaque(picture), {io::ImageCodec::jpeg, kPosterQuality}).bytes;
}

}  // namespace

CleanModel load_model(Job& job, ModelOptions const& options) {
  io::ArchiveEntry const& entry = *job.entry;
  ModelRow& row = job.row;
  io::Blob const file = io::map_file(entry.file);
  row.input_hash = io::content_hash(file.bytes);
  io::Resolve const resolve = io::recording(io::resolve_in(entry.file.parent_path()), row.dependencies);
  SourceModel source = io::read_model(ending(entry.path), file, resolve, options.read);
  row.up = entry.up;
  if (entry.up == io::UpAxis::z) io::turn_z_up(source);
  row.source_triangles = source.mesh.triangles.size();
  row.source_vertices = source.mesh.positions.size();
  row.source_coloured = has_colour(source);
  row.notes = source.notes;
  std::optional<SourceModel> thin = cluster(source, options.cluster);
  CleanModel cleaned = clean(std::move(thin ? *thin : source));
  row.repairs = cleaned.repairs;
  if (thin) {
    row.thinned_triangles = cleaned.model.mesh.triangles.size();
    if (options.publish.certificate && cleaned.repairs.flipped_faces == 0)
      row.thinning_mse1e4 = thinning_error(std::move(source), cleaned.model, options.publish.viewport);
  }
  return cleaned;
}

Original survey_model(std::shared_ptr<CleanModel const> const& clean, ModelOptions const& options, Job& job) {
  int const occlusion_rays = options.bake.occlusion == Occlusion::none ? 0 : options.bake.occlusion_rays;
  SurveyedModel model = survey(std::shared_ptr<SourceModel const>(clean, &clean->model), occlusion_rays);
  MeasureOptions measure;
  measure.size = options.publish.viewport;
  measure.occlusion = options.bake.occlusion;
  if (!options.publish.certificate) measure.count = 1;  // the poster's
  Reference seen = options.publish.certificate ? reference(model, measure) : viewpoints(model, measure);
  std::vector<Judge> deciding = judges_of(model, options);
  bool const sampled = searches(options) || options.parameterize.unfolding == Unfolding::detail;
  double const count = std::clamp(kSamplesPerByte * 1000 * options.fit.max_kb, kFewestSamples, kMostSamples);
  Original made{std::move(model), {}, std::move(seen), std::move(deciding), {}};
  if (shows_outside_only(made.whole, options)) made.outer = outer_model(made.whole, job.row);
  if (sampled) made.samples = sample_surface(made.model(), std::size_t(count));
  return made;
}

Levels simplify_model(Original const& original, ModelOptions const& options) {
  TriMesh const welded = weld(*original.model().model);
  Levels levels;
  if (!searches(options)) {
    SimplifyOptions settled = options.simplify;
    if (settled.triangles == 0) settled.triangles = SimplifyOptions{}.triangles;
    levels.fixed = simplify(welded, settled);
    return levels;
  }
  levels.plain.emplace(welded, options.simplify);
  bool const few = original.model().model->mesh.triangles.size() <= kMostOwnTriangles;
  if (few && !options.encode.x3dom) levels.textured = own_texture(*original.model().model);
  if (original.model().surface.coloured()) {
    TriMesh const finest = levels.plain->at(Progression::kFinest).mesh;
    std::vector<V3f> const colours = colours_near(original.model(), finest);
    levels.coloured.emplace(finest, options.simplify, VertexColours{colours, kColourWeight});
  }
  return levels;
}

Subject subject_of(Original const& original, Levels const& levels, ModelOptions const& options) {
  SurveyedModel const& model = original.model();
  Subject subject;
  subject.triangles = model.model->mesh.triangles.size();
  subject.coloured = model.surface.coloured();
  subject.flat = !original.samples.flat.empty();
  subject.creased = original.samples.creased && !model.surface.unlit();
  if (levels.textured) subject.own_texture = longer_side(own_image(*model.model, *levels.textured));
  bool const occluded = options.bake.occlusion != Occlusion::none && !has_colour(*model.model);
  if (double const limit = deviation_limit(original, options); limit > 0 && levels.plain)
    subject.fixed_triangles = fewest_within(limit, *levels.plain, original.samples);
  MapCodec const codec = options.encode.colour_codec;
  subject.avif = codec == MapCodec::avif || (codec == MapCodec::automatic && !common_maps(options.encode.profile));
  subject.needs_map = model.surface.common_alpha() != AlphaMode::opaque || occluded;
  return subject;
}

Finished certify(EncodedThumbnail const& thumbnail, PublishOptions const& options, Job& job) {
  Reference const& reference = job.original->reference;
  ModelRow& row = job.row;
  std::vector<Image> drawn = pictures(decode(thumbnail, reference.options.occlusion), reference);
  if (!reference.pictures.empty()) {
    row.measurement = measurement(reference, compare(reference.pictures, drawn));
    row.series = series_sizes(reference);
    row.verdict = verdict(row.bytes.total, row.measurement->mean.mse1e4, rivals(row.series));
  }
  Finished finished{thumbnail, std::move(drawn.front()), {}};
  row.sphere = reference.sphere;
  if (options.series)
    finished.series = series_files(job.original->whole, reference, SeriesOptions{.rows = options.series_rows});
  return finished;
}

void publish_model(Finished const& finished, ModelOptions const& options, fs::path const& gallery, Job& job) {
  ModelRow& row = job.row;
  ModelFolder folder(gallery, row);
  folder.write("thumb.glb", finished.thumbnail.glb);
  folder.write("poster.jpg", poster_jpeg(finished.poster));
  for (NamedFile const& file : finished.thumbnail.x3d) folder.write("x3d/" + file.name, file.bytes);
  if (!finished.thumbnail.x3d.empty()) folder.write("thumb.x3d.zip", finished.thumbnail.x3d_zip);
  if (finished.series) {
    publish_series(gallery / "models" / row.slug / "series", *finished.series);
    for (SeriesFile const& file : finished.series->files) folder.enter("series/" + file.name);
    folder.enter("series/series.json");
    auto const& manifest = finished.series->manifest;
    row.series_written = {manifest["frames"], manifest["rows"], manifest["bytes"]};
  }
  folder.settle();
  if (row.measurement) folder.certify(certificate_text(row, options));
  row.status = "done";
}

}  // namespace vitrine::graph
