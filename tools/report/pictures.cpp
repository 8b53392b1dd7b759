// SPDX-License-Identifier: Apache-2.0
#include "tools/report/pictures.h"

#include "graph/options_json.h"
#include "graph/stage_body.h"
#include "graph/steps.h"
#include "io/image_codec.h"
#include "io/publish.h"
#include "stages/contact_sheet.h"
#include "stages/parameterize.h"
#include "tools/printable.h"
#include "tools/report/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace vitrine::report {
namespace {

namespace fs = std::filesystem;

constexpr int kStageSize = 320;

Picture publish_picture(Image const& image, fs::path const& gallery, std::string file, std::string caption) {
  io::publish_file(gallery / file, io::encode_image(image, {io::ImageCodec::png}).bytes);
  return {std::move(file), std::move(caption), image.width, image.height};
}

/// An original as convert read it.
std::shared_ptr<CleanModel const> load(io::ArchiveEntry const& entry, Model const& model) {
  graph::Job job;
  job.entry = &entry;
  graph::ModelOptions options = graph::options_from_json(model.certificate.at("options"));
  options.publish.certificate = false;  // nothing is measured here
  return std::make_shared<CleanModel const>(graph::load_model(job, options));
}

SurveyedModel surveyed(SourceModel model) { return survey(std::make_shared<SourceModel const>(std::move(model))); }

/// What the certificate was measured with.
MeasureOptions measured(Model const& model) {
  Json const& measure = model.certificate.at("measure");
  MeasureOptions options;
  options.count = measure.at("views");
  options.size = measure.at("size");
  options.occlusion = graph::options_from_json(model.certificate.at("options")).bake.occlusion;
  return options;
}

SourceModel read_thumbnail_file(fs::path const& gallery, Model const& model) {
  fs::path const folder = gallery / "models" / model.slug;
  io::ReadOptions options;
  options.occlusion_maps = measured(model).occlusion == Occlusion::occlusion;
  return io::read_model(".glb", io::map_file(folder / "thumb.glb"), io::resolve_in(folder), options);
}

// ---- Figure 5
// ---------------------------------------------------------------------------------------------------------

/// The turntable's first view and, below, the thumbnail's worst.
Picture side_by_side(Gallery const& gallery, Model const& model, SurveyedModel const& original) {
  Reference seen = viewpoints(original, measured(model));
  std::size_t const worst = std::min(model.thumbnail.worst_view, seen.cameras.size() - 1);
  seen.cameras = worst == 0 ? std::vector{seen.cameras[0]} : std::vector{seen.cameras[0], seen.cameras[worst]};
  Image const sheet =
      contact_sheet(pictures(original, seen), pictures(surveyed(read_thumbnail_file(gallery.folder, model)), seen));
  std::string const views =
      worst == 0 ? "View 0, the worst." : fmt::format("View 0 above, view {}, the worst, below.", worst);
  return publish_picture(
      sheet, gallery.folder, "paper/figure5-" + model.slug + ".png",
      fmt::format("{} {:.1f} KB, MSE x 10^4 {:.2f}, SSIM {:.3f}.", views, double(model.thumbnail.bytes) / 1000,
                  model.thumbnail.mse1e4, model.thumbnail.ssim));
}

// ---- Figure 1
// ---------------------------------------------------------------------------------------------------------

/// Hue 0 to 1 at half saturation, as linear 16-bit colour.
Rgba16 pastel(double hue) {
  Rgba16 colour{0, 0, 0, 65535};
  for (int k = 0; k < 3; ++k) {
    double const wave = 0.5 + 0.5 * std::cos(2 * 3.14159265358979 * (hue - k / 3.0));
    colour[k] = static_cast<std::uint16_t>(std::lround(65535 * (0.08 + 0.75 * wave * wave)));
  }
  return colour;
}

Image view(SurveyedModel const& model, std::vector<Camera> const& cameras, bool grey) {
  return opaque(render(model, cameras, {kStageSize, Light::head, grey}).front());
}

/// A map as it is, without alpha, scaled to the size of the other pictures by whole texels.
Image shown_map(Image const& map) {
  Image out{kStageSize, kStageSize, 3, ColourSpace::srgb, {}};
  for (int y = 0; y < kStageSize; ++y)
    for (int x = 0; x < kStageSize; ++x)
      for (int k = 0; k < 3; ++k) {
        std::size_t const texel = std::size_t(y * map.height / kStageSize) * map.width + x * map.width / kStageSize;
        out.texels.push_back(map.texels[texel * map.channels + (map.channels < 3 ? 0 : k)]);
      }
  return out;
}

SourceModel bare(TriMesh const& mesh) {
  SourceModel model;
  model.mesh = mesh;
  return model;
}

void add_maps(SourceModel const& thumbnail, Gallery const& gallery, std::vector<Picture>& out) {
  Material const& material = thumbnail.materials.front();
  for (auto const& [use, name, caption] :
       {std::tuple(material.colour_map.image, "colour", "the atlas: colours of the original"),
        std::tuple(material.normal_map.image, "normal", "the atlas: normals of the original")})
    if (use >= 0)
      out.push_back(publish_picture(shown_map(thumbnail.images[use]), gallery.folder,
                                    fmt::format("paper/figure1-{}.png", name), caption));
}

bool has_atlas(Model const& model) { return model.certificate.at("mesh").at("charts") > 0; }

std::string counted(std::size_t triangles) { return report::shown(Cell(double(triangles), 0)) + " triangles"; }

std::vector<Picture> stages_of(Gallery const& gallery, Model const& model, SurveyedModel const& original) {
  MeasureOptions options;
  options.count = 1;
  std::vector<Camera> const cameras = viewpoints(original, options).cameras;
  graph::ModelOptions chosen = graph::options_from_json(model.certificate.at("options"));
  chosen.simplify.triangles = int(model.thumbnail.triangles);
  SimplifiedMesh const light = simplify(weld(*original.model), chosen.simplify);
  ChartedMesh const charts = segment(light.mesh, chosen.segment);
  SourceModel thumbnail = read_thumbnail_file(gallery.folder, model);

  std::vector<Picture> out;
  auto const add = [&](Image const& image, char const* name, std::string caption) {
    out.push_back(
        publish_picture(image, gallery.folder, fmt::format("paper/figure1-{}.png", name), std::move(caption)));
  };
  add(view(original, cameras, !model.coloured), "original", "the scan: " + counted(model.triangles));
  add(view(surveyed(bare(light.mesh)), cameras, true), "simplified",
      "simplified: " + counted(light.mesh.triangles.size()));
  if (has_atlas(model))
    add(view(surveyed(chart_coloured(charts)), cameras, false), "charts",
        fmt::format("cut into {} charts", charts.charts));
  if (has_atlas(model)) add_maps(thumbnail, gallery, out);
  bool const plain = !model.coloured && thumbnail.materials.front().colour_map.image < 0;
  add(view(surveyed(std::move(thumbnail)), cameras, plain), "thumbnail",
      fmt::format("the thumbnail: {:.1f} KB", double(model.thumbnail.bytes) / 1000));
  return out;
}

/// The first model with a colour atlas, as it shows all stages; else the first with any atlas, else the first.
std::size_t subject(std::vector<Model> const& models) {
  auto const stages = [](Model const& m) { return has_atlas(m) * (m.thumbnail.colour > 0 ? 2 : 1); };
  auto const less = [&](Model const& a, Model const& b) { return stages(a) < stages(b); };
  return std::size_t(std::max_element(models.begin(), models.end(), less) - models.begin());
}

}  // namespace

SourceModel chart_coloured(ChartedMesh const& charts) {
  constexpr double kGolden = 0.6180339887498949;
  SourceModel model;
  for (std::size_t f = 0; f < charts.mesh.triangles.size(); ++f) {
    auto const first = std::uint32_t(model.mesh.positions.size());
    model.mesh.triangles.push_back({first, first + 1, first + 2});
    for (std::uint32_t v : charts.mesh.triangles[f]) {
      model.mesh.positions.push_back(charts.mesh.positions[v]);
      model.colours.push_back(pastel(charts.face_charts[f] * kGolden));
    }
  }
  return model;
}

Pictures publish_pictures(Study const& study, io::Archive const& archive) {
  Gallery const& gallery = study.gallery;
  std::size_t const shown = subject(gallery.models);
  Pictures out{gallery.models[shown].title, {}, std::vector<std::optional<Picture>>(gallery.models.size())};
  for (std::size_t m = 0; m < gallery.models.size(); ++m) try {
      auto const clean = load(archive.entries[m], gallery.models[m]);
      SurveyedModel const original =
          survey(std::shared_ptr<SourceModel const>(clean, &clean->model), occlusion_rays(measured(gallery.models[m])));
      out.sides[m] = side_by_side(gallery, gallery.models[m], original);
      if (m == shown) out.stages = stages_of(gallery, gallery.models[m], original);
    } catch (...) {
      graph::Failure const failure = graph::current_failure("picture");
      fmt::print(stderr, "error: {}: {}\n", tools::printable(gallery.models[m].input),
                 tools::printable(failure.reason));
    }
  return out;
}

}  // namespace vitrine::report
