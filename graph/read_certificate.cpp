// SPDX-License-Identifier: Apache-2.0
#include "graph/certificate.h"

#include "graph/bounded_json.h"
#include "graph/model_folder.h"
#include "graph/options_json.h"
#include "io/dependencies.h"
#include "stages/error.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace vitrine::graph {
namespace {

using json = StrictOrderedJson;

/// An enum's value by the name that shown() gives it.
template <class Enum>
Enum named(json const& name) {
  auto const& names = EnumNames<Enum>::names;
  auto const found = std::find(names.begin(), names.end(), name.get_ref<std::string const&>());
  if (found == names.end()) throw Error(ErrorKind::invalid_input, "there is no choice " + name.dump(), "convert again");
  return static_cast<Enum>(found - names.begin());
}

void read_input(json const& in, ModelRow& row) {
  row.input = in.at("path");
  row.input_hash = in.at("hash");
  row.input_bytes = in.at("bytes");
  row.source_triangles = in.at("triangles");
  row.source_vertices = in.at("vertices");
  row.source_coloured = in.at("coloured");
  row.up = in.at("up") == "z" ? io::UpAxis::z : io::UpAxis::y;
  for (json const& file : in.at("dependencies"))
    row.dependencies[file.at("path")] = file.at("hash").is_null() ? std::string() : file.at("hash").get<std::string>();
}

void read_made(json const& in, ModelRow& row) {
  json const &bytes = in.at("bytes"), &mesh = in.at("mesh"), &bake = in.at("bake");
  row.bytes = {bytes.at("total"),  bytes.at("geometry"),  bytes.at("colour"),
               bytes.at("normal"), bytes.at("occlusion"), bytes.at("other")};
  row.triangles = mesh.at("triangles");
  row.vertices = mesh.at("vertices");
  row.charts = mesh.at("charts");
  row.chart_retries = mesh.at("chartRetries");
  row.atlas_fill = mesh.at("atlasFill");
  row.simplify_error = mesh.at("simplifyError");
  row.bake.texels = bake.at("texels");
  row.bake.samples = bake.at("samples");
  row.bake.misses = std::uint64_t(std::llround(bake.at("missRate").get<double>() * double(row.bake.samples)));
  if (auto const angle = bake.find("normalAngle"); angle != bake.end())
    row.normal_angle = {angle->at("p50"), angle->at("p99")};
  row.x3d_bytes = in.value("x3dBytes", std::size_t{0});
  if (auto const thinned = in.find("thinned"); thinned != in.end()) {
    row.thinned_triangles = thinned->at("triangles");
    if (thinned->contains("mse1e4")) row.thinning_mse1e4 = thinned->at("mse1e4").get<double>();
  }
  if (auto const series = in.find("seriesFiles"); series != in.end())
    row.series_written = {series->at("frames"), series->at("rows"), series->at("bytes")};
  if (auto const sphere = in.find("sphere"); sphere != in.end()) {
    json const& centre = sphere->at("centre");
    row.sphere = {{centre.at(0), centre.at(1), centre.at(2)}, sphere->at("radius")};
  }
}

Recipe read_recipe(json const& in) {
  Recipe recipe;
  recipe.triangles = in.at("triangles");
  recipe.shading = named<Shading>(in.at("shading"));
  recipe.painting = named<Painting>(in.at("painting"));
  recipe.position_bits = in.at("positionBits");
  recipe.normal_bits = in.value("normalBits", recipe.normal_bits);
  recipe.fitted = in.value("fitted", recipe.fitted);
  recipe.colour_weight = in.at("colourWeight");
  recipe.colour_bits = in.value("colourBits", recipe.colour_bits);
  recipe.smoothing = in.value("smoothing", recipe.smoothing);
  recipe.texture = in.value("texture", recipe.texture);
  if (in.contains("unfolding")) recipe.unfolding = named<Unfolding>(in.at("unfolding"));
  recipe.avif = in.value("avif", recipe.avif);
  recipe.full_chroma = in.value("fullChroma", recipe.full_chroma);
  recipe.polished = in.value("polished", recipe.polished);
  return recipe;
}

void read_search(json const& in, ModelRow& row) {
  row.recipe = read_recipe(in.at("recipe"));
  row.map_quality = in.at("recipe").value("mapQuality", 0);
  for (json const& one : in.at("trials")) {
    Trial trial = failed_trial(read_recipe(one));
    trial.map_quality = one.value("mapQuality", 0);
    if (!one.contains("failed")) {
      trial.bytes = one.at("bytes");
      trial.map_bytes = one.at("mapBytes");
      trial.error = one.at("mse1e4");
      trial.score = one.at("score");
    }
    row.trials.push_back(trial);
  }
}

Measurement read_measure(json const& in) {
  Measurement m;
  m.options.views = named<ViewSet>(in.at("set"));
  m.options.count = in.at("views");
  m.options.size = in.at("size");
  m.options.light = named<Light>(in.at("light"));
  m.options.occlusion = named<Occlusion>(in.at("ao"));
  m.mean = {in.at("mse1e4"), in.at("foregroundMse1e4"), in.at("psnr"),
            in.at("ssim"),   in.at("foregroundSsim"),   in.at("iou")};
  m.worst_mse1e4 = in.at("worstMse1e4");
  m.worst_view = in.at("worstView");
  m.coverage = in.at("coverage");
  return m;
}

Verdict read_verdict(json const& in) {
  Verdict verdict{in.at("winner") == "3d", {}};
  if (json const& rival = in.at("rival"); !rival.is_null())
    verdict.rival = {rival.at("codec"), rival.at("frames"), rival.at("bytes"), rival.at("turningMse1e4")};
  return verdict;
}

Repairs read_repairs(json const& in) {
  return {in.at("nonfiniteVertices"), in.at("degenerateFaces"), in.at("duplicateFaces"), in.at("repairedNormals"),
          in.at("flippedFaces")};
}

}  // namespace

std::vector<SeriesSizes> read_series(json const& in) {
  std::vector<SeriesSizes> series;
  for (auto const& [codec, sizes] : in.items()) {
    series.push_back({codec, {}});
    for (auto const& [key, size] : sizes.items()) {
      int frames = 0;
      std::from_chars(key.data(), key.data() + key.size(), frames);
      series.back().sizes.push_back({frames, size.at("bytes"), size.at("codingMse1e4"), size.at("turningMse1e4")});
    }
  }
  return series;
}

std::optional<Record> record_from_certificate(std::string const& text, std::string const& slug) try {
  std::optional<json> const read = bounded_json(text);
  if (!read || read->at("schema") != 1 || read->at("seal") != seal_of(*read)) return {};
  json const& in = *read;
  Record record;
  record.settings = in.at("settings");
  ModelRow& row = record.row;
  row.slug = slug;
  row.title = in.at("title");
  row.status = "done";
  read_input(in.at("input"), row);
  read_made(in, row);
  if (in.contains("search")) read_search(in.at("search"), row);
  if (in.contains("measure")) row.measurement = read_measure(in.at("measure"));
  if (in.contains("series")) row.series = read_series(in.at("series"));
  if (in.contains("verdict")) row.verdict = read_verdict(in.at("verdict"));
  row.repairs = read_repairs(in.at("repairs"));
  row.notes = in.at("notes");
  row.files = in.at("files");
  row.files["models/" + slug + "/certificate.json"] = io::content_hash(text);
  name_files(row);
  return record;
} catch (json::exception const&) {
  return {};
} catch (Error const&) {
  return {};
}

}  // namespace vitrine::graph
