// SPDX-License-Identifier: Apache-2.0
#include "graph/report.h"

#include "graph/options_json.h"
#include "graph/profile.h"
#include "io/csv.h"

#include <algorithm>
#include <numeric>

namespace vitrine::graph {
namespace {

using json = nlohmann::ordered_json;

double total_seconds(ModelRow const& row) {
  return std::accumulate(row.seconds.begin(), row.seconds.end(), 0.0,
                         [](double s, auto const& t) { return s + t.second; });
}

json seconds_json(ModelRow const& row) {
  json stages = json::object();
  for (auto const& [stage, seconds] : row.seconds) stages[stage] = seconds;
  return stages;
}

}  // namespace

json repairs_json(Repairs const& r) {
  return {{"nonfiniteVertices", r.nonfinite_vertices},
          {"degenerateFaces", r.degenerate_faces},
          {"duplicateFaces", r.duplicate_faces},
          {"repairedNormals", r.repaired_normals},
          {"flippedFaces", r.flipped_faces}};
}

namespace {

json measure_json(Measurement const& m) {
  MeasureOptions const& o = m.options;
  return {{"set", shown(o.views)},
          {"views", o.count},
          {"size", o.size},
          {"light", shown(o.light)},
          {"ao", shown(o.occlusion)},
          {"mse1e4", m.mean.mse1e4},
          {"foregroundMse1e4", m.mean.foreground_mse1e4},
          {"psnr", m.mean.psnr},
          {"ssim", m.mean.ssim},
          {"foregroundSsim", m.mean.foreground_ssim},
          {"iou", m.mean.iou},
          {"worstMse1e4", m.worst_mse1e4},
          {"worstView", m.worst_view},
          {"coverage", m.coverage}};
}

}  // namespace

json recipe_json(Recipe const& r, int map_quality) {
  json out = {{"triangles", r.triangles},
              {"shading", shown(r.shading)},
              {"painting", shown(r.painting)},
              {"positionBits", r.position_bits},
              {"colourWeight", r.colour_weight}};
  if (has_normals(r)) out.update({{"normalBits", r.normal_bits}, {"fitted", r.fitted}});
  if (r.painting == Painting::vertices) out.update({{"colourBits", r.colour_bits}, {"smoothing", r.smoothing}});
  if (r.painting == Painting::map) out.update({{"unfolding", shown(r.unfolding)}});
  if (is_textured(r))
    out.update({{"texture", r.texture}, {"mapQuality", map_quality}, {"avif", r.avif}, {"polished", r.polished}});
  if (r.avif) out.update({{"fullChroma", r.full_chroma}});
  return out;
}

namespace {

json verdict_json(Verdict const& verdict) {
  json out = {{"winner", verdict.thumbnail_wins ? "3d" : "series"}, {"rival", nullptr}};
  if (verdict.rival)
    out["rival"] = {{"codec", verdict.rival->codec},
                    {"frames", verdict.rival->frames},
                    {"bytes", verdict.rival->bytes},
                    {"turningMse1e4", verdict.rival->turning_mse1e4}};
  return out;
}

json sphere_json(BoundingSphere const& sphere) {
  return {{"centre", {sphere.centre.x, sphere.centre.y, sphere.centre.z}}, {"radius", sphere.radius}};
}

json row_json(ModelRow const& row) {
  json out = {{"input", row.input}, {"title", row.title}, {"status", row.status}};
  if (row.status != "done") {
    out["stage"] = row.failure.stage;
    out["reason"] = row.failure.reason;
    out["remedy"] = row.failure.remedy;
  } else {
    out["thumb"] = row.thumb;
    out["poster"] = row.poster;
    if (!row.series_folder.empty()) out["seriesFolder"] = row.series_folder;
    if (!row.certificate.empty()) out["certificate"] = row.certificate;
    if (!row.x3d.empty()) out["x3d"] = row.x3d;
    if (!row.x3d.empty()) out["x3dZip"] = row.x3d_zip;
    out.update(outcome_json(row));
  }
  out["source"] = {{"bytes", row.input_bytes},
                   {"triangles", row.source_triangles},
                   {"vertices", row.source_vertices},
                   {"coloured", row.source_coloured}};
  out["repairs"] = repairs_json(row.repairs);
  out["notes"] = row.notes;
  out["memory"] = row.memory;
  out["seconds"] = total_seconds(row);
  out["stages"] = seconds_json(row);
  return out;
}

json stages_json(std::vector<ModelRow> const& rows) {
  Profile profile;
  for (ModelRow const& row : rows) profile.add(row);
  return profile_json(profile.stages());
}

}  // namespace

std::string describe(ModelRow const& failed) {
  Failure const& f = failed.failure;
  return "error: " + failed.input + ": " + f.stage + ": " + f.reason + (f.remedy.empty() ? "" : "; " + f.remedy);
}

json outcome_json(ModelRow const& row) {
  double const samples = double(std::max<std::uint64_t>(row.bake.samples, 1));
  json out = {
      {"bytes",
       {{"total", row.bytes.total},
        {"geometry", row.bytes.geometry},
        {"colour", row.bytes.colour},
        {"normal", row.bytes.normal},
        {"occlusion", row.bytes.occlusion},
        {"other", row.bytes.other}}},
      {"mesh",
       {{"triangles", row.triangles},
        {"vertices", row.vertices},
        {"charts", row.charts},
        {"chartRetries", row.chart_retries},
        {"atlasFill", row.atlas_fill},
        {"simplifyError", row.simplify_error}}},
      {"bake",
       {{"texels", row.bake.texels}, {"samples", row.bake.samples}, {"missRate", double(row.bake.misses) / samples}}}};
  if (auto const& angle = row.normal_angle) out["bake"]["normalAngle"] = {{"p50", angle->p50}, {"p99", angle->p99}};
  if (row.recipe)
    out["search"] = {{"trials", row.trials.size()}, {"recipe", recipe_json(*row.recipe, row.map_quality)}};
  if (row.x3d_bytes > 0) out["x3dBytes"] = row.x3d_bytes;
  if (row.thinned_triangles > 0) {
    out["thinned"] = {{"triangles", row.thinned_triangles}};
    if (row.thinning_mse1e4) out["thinned"]["mse1e4"] = *row.thinning_mse1e4;
  }
  if (auto const& s = row.series_written)
    out["seriesFiles"] = {{"frames", s->frames}, {"rows", s->rows}, {"bytes", s->bytes}};
  if (row.sphere) out["sphere"] = sphere_json(*row.sphere);
  if (!row.measurement) return out;
  out["measure"] = measure_json(*row.measurement);
  out["series"] = to_json(row.series);
  if (row.verdict) out["verdict"] = verdict_json(*row.verdict);
  return out;
}

json report_json(std::vector<ModelRow> const& rows, std::string const& archive, json const& options,
                 double wall_seconds) {
  json out = {{"schema", 1}, {"program", "vitrine"}, {"archive", archive}, {"options", options}};
  auto const done = std::count_if(rows.begin(), rows.end(), [](ModelRow const& r) { return r.status == "done"; });
  out["models"] = rows.size();
  out["done"] = done;
  out["failed"] = rows.size() - std::size_t(done);
  out["seconds"] = wall_seconds;
  out["stages"] = stages_json(rows);
  out["rows"] = json::array();
  for (ModelRow const& row : rows) out["rows"].push_back(row_json(row));
  return out;
}

std::string report_csv(std::vector<ModelRow> const& rows) {
  std::string out =
      "input,title,status,stage,reason,remedy,thumb,bytes,geometry,colour,normal,occlusion,other,x3d,triangles,"
      "vertices,"
      "charts,"
      "mse1e4,ssim,atlas_fill,source_triangles,source_bytes,seconds,notes\r\n";
  for (ModelRow const& row : rows) {
    std::string notes;
    for (std::string const& note : row.notes) notes += (notes.empty() ? "" : "; ") + note;
    std::vector<std::string> const cells = {row.input,
                                            row.title,
                                            row.status,
                                            row.failure.stage,
                                            row.failure.reason,
                                            row.failure.remedy,
                                            row.thumb,
                                            std::to_string(row.bytes.total),
                                            std::to_string(row.bytes.geometry),
                                            std::to_string(row.bytes.colour),
                                            std::to_string(row.bytes.normal),
                                            std::to_string(row.bytes.occlusion),
                                            std::to_string(row.bytes.other),
                                            std::to_string(row.x3d_bytes),
                                            std::to_string(row.triangles),
                                            std::to_string(row.vertices),
                                            std::to_string(row.charts),
                                            row.measurement ? std::to_string(row.measurement->mean.mse1e4) : "",
                                            row.measurement ? std::to_string(row.measurement->mean.ssim) : "",
                                            std::to_string(row.atlas_fill),
                                            std::to_string(row.source_triangles),
                                            std::to_string(row.input_bytes),
                                            std::to_string(total_seconds(row)),
                                            notes};
    for (std::size_t i = 0; i < cells.size(); ++i) out += (i ? "," : "") + io::csv_cell(cells[i]);
    out += "\r\n";
  }
  return out;
}

std::string to_text(json const& value) { return value.dump(1, ' ', false, json::error_handler_t::replace) + "\n"; }

json gallery_json(std::vector<ModelRow> const& rows) {
  json objects = json::array();
  for (ModelRow const& row : rows) {
    if (row.status != "done") continue;
    json object = {{"slug", row.slug},     {"title", row.title},       {"thumb", row.thumb},
                   {"poster", row.poster}, {"bytes", row.bytes.total}, {"triangles", row.triangles}};
    if (row.measurement) object["mse1e4"] = row.measurement->mean.mse1e4;
    if (row.sphere) object["sphere"] = sphere_json(*row.sphere);
    if (auto const& s = row.series_written)
      object["series"] = {{"manifest", row.series_folder + "/series.json"},
                          {"frames", s->frames},
                          {"rows", s->rows},
                          {"bytes", s->bytes}};
    object["metadata"] = row.metadata;
    objects.push_back(std::move(object));
  }
  return {{"schema", 1}, {"objects", std::move(objects)}};
}

}  // namespace vitrine::graph
