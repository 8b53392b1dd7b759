// SPDX-License-Identifier: Apache-2.0
#include "graph/trial_steps.h"

#include "io/fault.h"
#include "io/read_model.h"
#include "io/write_glb.h"
#include "stages/angle_error.h"
#include "stages/detail.h"
#include "stages/paint.h"
#include "stages/refit.h"

#include <utility>

namespace vitrine::graph {
namespace {

bool refits(Job const& job) { return job.study->recipe().fitted && job.study->options().fit.without != Choice::refit; }

/// Where vertices bear normals, the slopes of the faces do not show.
RefitOptions refit_options(Recipe const& recipe) {
  RefitOptions options;
  if (has_normals(recipe)) options.facet_weight = 0;
  return options;
}

}  // namespace

SimplifiedMesh shape_model(Job& job) {
  Levels const& levels = *job.levels;
  Recipe const& recipe = job.study->recipe();
  SimplifiedMesh light = levels.fixed                       ? *levels.fixed
                         : recipe.painting == Painting::own ? simplify(*levels.textured, recipe.triangles)
                         : recipe.colour_weight > 0         ? levels.coloured->at(recipe.triangles)
                                                            : levels.plain->at(recipe.triangles);
  job.row.simplify_error = light.error;
  if (!levels.fixed && refits(job)) light.mesh = refit(light.mesh, job.original->samples, refit_options(recipe));
  return light;
}

BakedModel paint_model(SimplifiedMesh const& light, Job& job) {
  Recipe const& recipe = job.study->recipe();
  if (recipe.painting == Painting::own)
    return wear_own_texture(light, *job.levels->textured, job.original->model(), job.original->samples,
                            {recipe.position_bits, recipe.texture, has_normals(recipe),
                             recipe.shading == Shading::creased, recipe.normal_bits});
  Grid const grid = cube_about(light.mesh, recipe.position_bits);
  QuantizedMesh const placed = refits(job)
                                   ? round_to_grid(light.mesh, grid, job.original->samples, refit_options(recipe))
                                   : quantize(light.mesh, grid);
  PaintOptions options;
  options.swatches = recipe.painting == Painting::swatches;
  options.colour_bits = recipe.colour_bits;
  options.smoothing = recipe.smoothing;
  options.palette = job.study->options().fit.without != Choice::palette;
  options.normals = has_normals(recipe);
  options.creases = recipe.shading == Shading::creased;
  options.normal_bits = recipe.normal_bits;
  return paint(placed, job.original->model(), job.original->samples, options);
}

FlatCharts flatten_charts(ChartedMesh const& charts, Job& job) {
  switch (job.study->options().parameterize.unfolding) {
    case Unfolding::rigid:
      return parameterize(charts, std::vector<float>(charts.mesh.triangles.size(), 1));
    case Unfolding::detail:
      return parameterize(charts, detail_lengths(charts.mesh, job.original->samples));
    default:
      return parameterize(charts);
  }
}

Atlas pack_charts(std::shared_ptr<FlatCharts const> const& flat, Job& job) {
  job.study->makings().charts = flat;
  Atlas atlas = pack(*flat, job.study->options().pack);
  job.row.charts = atlas.charts;
  job.row.chart_retries = flat->retries;
  job.row.atlas_fill = atlas.fill;
  return atlas;
}

BakedModel bake_maps(std::shared_ptr<Atlas const> const& atlas, Job& job) {
  job.study->makings().atlas = atlas;
  ModelOptions const& options = job.study->options();
  BakeOptions wanted = options.bake;
  wanted.derived_normals = options.encode.x3dom;
  BakedModel baked = bake(quantize(*atlas, options.quantize), job.original->model(), wanted);
  job.row.bake = baked.statistics;
  if (Recipe const& recipe = job.study->recipe(); recipe.shading == Shading::creased)
    wear_normals(baked, job.original->model(), job.original->samples,
                 {.creases = true, .normal_bits = recipe.normal_bits});
  return baked;
}

EncodedThumbnail encode_thumbnail(std::shared_ptr<BakedModel const> const& baked, Job& job) {
  job.study->makings().baked = baked;
  ModelOptions const& options = job.study->options();
  Recipe const& recipe = job.study->recipe();
  std::size_t const most = !job.levels->fixed && is_filled(recipe) ? std::size_t(recipe.ceiling) : io::kAnySize;
  EncodedThumbnail thumbnail = io::encode(*baked, job.row.title, options.encode, most);
  io::garble("result", job.entry->path, thumbnail.glb);
  ModelRow& row = job.row;
  row.triangles = thumbnail.triangles;
  row.vertices = thumbnail.vertices;
  row.bytes = {thumbnail.glb.size(), thumbnail.geometry,  thumbnail.colour,
               thumbnail.normal,     thumbnail.occlusion, thumbnail.other};
  row.x3d_bytes = thumbnail.x3d_zip.size();
  if (thumbnail.normal_map) row.normal_angle = angle_error(*baked->normal, *thumbnail.normal_map);
  return thumbnail;
}

SurveyedModel decode(EncodedThumbnail const& thumbnail, Occlusion occlusion) {
  io::Resolve const nothing = [](std::string_view) { return std::nullopt; };
  io::ReadOptions options;
  options.occlusion_maps = occlusion == Occlusion::occlusion;
  return survey(std::make_shared<SourceModel const>(io::read_model(".glb", io::own(thumbnail.glb), nothing, options)));
}

void weigh(std::shared_ptr<EncodedThumbnail const> const& file, Job& job) {
  Judgement found;
  if (!job.original->judges.empty()) {
    bool const structure = job.study->options().fit.without != Choice::structure;
    found = judgement(job.original->judges, decode(*file, job.study->options().bake.occlusion), structure);
  }
  job.study->add(job.row, file, found.mse1e4, found.score);
  static_cast<Made&>(job.row) = {};
}

}  // namespace vitrine::graph
