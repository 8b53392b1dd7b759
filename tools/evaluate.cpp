// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluate.h"

#include "io/glb_parts.h"
#include "io/image_codec.h"
#include "io/publish.h"
#include "stages/clean.h"
#include "stages/contact_sheet.h"
#include "stages/error.h"
#include "tools/command_line.h"
#include "tools/model_file.h"
#include "tools/printable.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace vitrine::tools {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// One side of the comparison, and what is said about it.
struct Side {
  fs::path file;
  SurveyedModel model;
  std::size_t triangles, vertices;  ///< as the file has them
  std::vector<std::string> notes;
};

Side survey_side(fs::path const& file, SourceModel model, std::size_t triangles, std::size_t vertices,
                 int occlusion_rays) {
  std::vector<std::string> notes = model.notes;
  return {file, survey(std::make_shared<SourceModel const>(std::move(model)), occlusion_rays), triangles, vertices,
          std::move(notes)};
}

Side load_original(EvaluateCommand const& command) {
  SourceModel source = read_file(command.original, command.read);
  if (command.up == io::UpAxis::z) io::turn_z_up(source);
  std::size_t const triangles = source.mesh.triangles.size(), vertices = source.mesh.positions.size();
  return survey_side(command.original, clean(std::move(source)).model, triangles, vertices,
                     occlusion_rays(command.measure));
}

/// Nothing is repaired: what a client cannot draw is the thumbnail's fault.
void require_drawable(SourceModel const& model) {
  if (model.mesh.triangles.empty())
    throw Error(ErrorKind::invalid_input, "the thumbnail has no triangles", "make it anew");
  auto const finite = [](V3f const& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); };
  auto const bad = std::find_if_not(model.mesh.positions.begin(), model.mesh.positions.end(), finite);
  if (bad != model.mesh.positions.end())
    throw Error(ErrorKind::invalid_input,
                fmt::format("vertex {} of the thumbnail is not finite", bad - model.mesh.positions.begin()),
                "make it anew");
}

Side load_thumbnail(EvaluateCommand const& command) {
  io::ReadOptions options = command.read;
  options.occlusion_maps = command.measure.occlusion == Occlusion::occlusion;
  SourceModel source = read_file(command.thumbnail, options);
  require_drawable(source);
  std::size_t const triangles = source.mesh.triangles.size(), vertices = source.mesh.positions.size();
  return survey_side(command.thumbnail, std::move(source), triangles, vertices, 0);
}

// ---- For machines
// -----------------------------------------------------------------------------------------------------

Json to_json(Difference const& d) {
  return {{"mse1e4", d.mse1e4}, {"foregroundMse1e4", d.foreground_mse1e4}, {"psnr", d.psnr},
          {"ssim", d.ssim},     {"foregroundSsim", d.foreground_ssim},     {"iou", d.iou}};
}

Json to_json(io::GlbParts const& parts, std::size_t total) {
  return {{"total", total},         {"geometry", parts.geometry},   {"colour", parts.colour},
          {"normal", parts.normal}, {"occlusion", parts.occlusion}, {"other", parts.other}};
}

Json to_json(Side const& side) {
  return {
      {"file", side.file.string()}, {"triangles", side.triangles}, {"vertices", side.vertices}, {"notes", side.notes}};
}

Json to_json(V3d const& v) { return {v.x, v.y, v.z}; }

Json camera_json(Camera const& camera, V3d const& target) {
  return {
      {"position", to_json(camera.eye)}, {"target", to_json(target)}, {"up", to_json(camera.up)}, {"fieldOfView", 30}};
}

Json measure_json(Reference const& reference, Comparison const& comparison) {
  MeasureOptions const& options = reference.options;
  Json measure = {{"set", shown(options.views)},   {"views", options.count},
                  {"size", options.size},          {"supersample", options.supersample},
                  {"light", shown(options.light)}, {"ao", shown(options.occlusion)}};
  measure.update(to_json(comparison.mean));
  measure["psnrOfMeanMse"] = comparison.psnr_of_mean_mse;
  measure["worstMse1e4"] = comparison.views[comparison.worst].mse1e4;
  measure["worstView"] = comparison.worst;
  return measure;
}

Json report(Side const& original, Side const& thumbnail, Json const& bytes, Reference const& reference,
            Comparison const& comparison) {
  Json out = {{"schema", 1}, {"original", to_json(original)}, {"thumbnail", to_json(thumbnail)}};
  out["original"]["coloured"] = reference.coloured;
  out["thumbnail"]["bytes"] = bytes;
  out["measure"] = measure_json(reference, comparison);
  for (std::size_t i = 0; i < comparison.views.size(); ++i) {
    Json view = to_json(comparison.views[i]);
    view["camera"] = camera_json(reference.cameras[i], reference.sphere.centre);
    out["views"].push_back(std::move(view));
  }
  return out;
}

// ---- For people
// -------------------------------------------------------------------------------------------------------

void print_side(Side const& side, std::string const& more) {
  fmt::print("{}: {} triangles, {} vertices{}\n", printable(side.file.string()), side.triangles, side.vertices, more);
  for (std::string const& note : side.notes) fmt::print("  note: {}\n", printable(note));
}

void print_figures(Reference const& reference, Comparison const& comparison) {
  MeasureOptions const& options = reference.options;
  Difference const &mean = comparison.mean, &worst = comparison.views[comparison.worst];
  std::string const occlusion = options.occlusion == Occlusion::none ? "" : ", ao " + shown(options.occlusion);
  fmt::print("{} {} views of {} pixels, {} light{}\n\n", options.count, shown(options.views), options.size,
             shown(options.light), occlusion);
  fmt::print("{:26}{:>10}{:>14}\n", "", "mean", fmt::format("worst (#{})", comparison.worst));
  auto const row = [&](char const* name, double Difference::*figure, int digits) {
    fmt::print("{:26}{:>10.{}f}{:>14.{}f}\n", name, mean.*figure, digits, worst.*figure, digits);
  };
  row("MSE x 10^4", &Difference::mse1e4, 3);
  row("MSE x 10^4, foreground", &Difference::foreground_mse1e4, 3);
  row("PSNR, dB", &Difference::psnr, 2);
  row("SSIM", &Difference::ssim, 4);
  row("SSIM, foreground", &Difference::foreground_ssim, 4);
  fmt::print("{:26}{:>10.2f}{:>14.2f}\n", "silhouette error, %", 100 * (1 - mean.iou), 100 * (1 - worst.iou));
}

}  // namespace

int evaluate(EvaluateCommand const& command) {
  io::Blob const glb = of_file(command.thumbnail, [&] { return io::map_file(command.thumbnail); });
  io::GlbParts const parts = of_file(command.thumbnail, [&] { return io::glb_parts(glb.bytes); });
  Side const thumbnail = of_file(command.thumbnail, [&] { return load_thumbnail(command); });
  Side const original = of_file(command.original, [&] { return load_original(command); });
  Reference const made = of_file(command.original, [&] { return reference(original.model, command.measure); });
  std::vector<Image> const drawn = pictures(thumbnail.model, made);
  Comparison const comparison = compare(made.pictures, drawn);

  if (!command.sheet.empty())
    io::publish_file(command.sheet, io::encode_image(contact_sheet(made.pictures, drawn), {io::ImageCodec::png}).bytes);
  Json const bytes = to_json(parts, glb.bytes.size());
  if (command.json) {
    fmt::print(
        "{}\n",
        report(original, thumbnail, bytes, made, comparison).dump(1, ' ', false, Json::error_handler_t::replace));
    return 0;
  }
  print_side(original, made.coloured ? "" : ", no colour");
  std::string list;
  for (auto const& [part, size] : bytes.items()) list += fmt::format(", {} {}", part, size.get<std::size_t>());
  print_side(thumbnail, "; bytes: " + list.substr(2));
  print_figures(made, comparison);
  return 0;
}

}  // namespace vitrine::tools
