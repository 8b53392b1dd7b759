// SPDX-License-Identifier: Apache-2.0
#include "tools/report/gallery.h"

#include "graph/certificate.h"
#include "io/blob.h"
#include "stages/error.h"

#include <algorithm>

namespace vitrine::report {
namespace {

namespace fs = std::filesystem;

constexpr char const* kRemedy = "make the gallery anew with vitrine convert";

template <class Read>
auto of_file(fs::path const& file, Read const& read) {
  try {
    return read();
  } catch (nlohmann::json::exception const& e) {
    throw Error(ErrorKind::invalid_input, file.string() + ": " + e.what(), kRemedy);
  } catch (Error const& e) {
    throw Error(e.kind(), file.string() + ": " + e.what(), e.remedy());
  }
}

/// A folder's name that leads nowhere else.
std::string slug_of(Json const& row) {
  std::string const slug = fs::path(row.at("certificate").get<std::string>()).parent_path().filename();
  bool const plain =
      !slug.empty() && slug.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-") == std::string::npos;
  if (!plain) throw Error(ErrorKind::invalid_input, "a model's folder has the name '" + slug + "'", kRemedy);
  return slug;
}

Model read_model(fs::path const& gallery, Json const& row) {
  std::string const slug = slug_of(row);
  fs::path const file = gallery / "models" / slug / "certificate.json";
  return of_file(file, [&] {
    Model model;
    model.certificate = read_json(file);
    Json const& input = model.certificate.at("input");
    model.input = row.at("input");
    model.title = row.at("title");
    model.slug = slug;
    model.up = input.value("up", "y");
    model.coloured = input.at("coloured");
    model.bytes = input.at("bytes");
    model.triangles = input.at("triangles");
    model.thumbnail = read_thumbnail(model.certificate);
    return model;
  });
}

}  // namespace

Json read_json(fs::path const& file) {
  return of_file(file, [&] {
    Json json = Json::parse(io::text(io::map_file(file)));
    if (json.at("schema") != 1)
      throw Error(ErrorKind::invalid_input, "its schema is " + json["schema"].dump() + ", not 1", kRemedy);
    return json;
  });
}

Thumbnail read_thumbnail(Json const& certificate) try {
  Json const &bytes = certificate.at("bytes"), &measure = certificate.at("measure");
  Thumbnail out;
  out.bytes = bytes.at("total");
  out.delivered = certificate.value("x3dBytes", out.bytes);
  out.geometry = bytes.at("geometry");
  out.colour = bytes.at("colour");
  out.normal = bytes.at("normal");
  out.occlusion = bytes.at("occlusion");
  out.other = bytes.at("other");
  out.mse1e4 = measure.at("mse1e4");
  out.ssim = measure.at("ssim");
  out.coverage = measure.at("coverage");
  out.worst_view = measure.at("worstView");
  out.triangles = certificate.at("mesh").at("triangles");
  if (certificate.contains("series")) out.series = graph::rivals(graph::read_series(certificate.at("series")));
  return out;
} catch (nlohmann::json::exception const& e) {
  throw Error(ErrorKind::invalid_input, std::string("not a certificate: ") + e.what(), kRemedy);
}

Gallery read_gallery(fs::path const& folder) {
  fs::path const file = folder / "report.json";
  if (!fs::exists(file))
    throw Error(ErrorKind::invalid_input, "no report.json in " + folder.string(),
                "name a folder that vitrine convert made");
  return of_file(file, [&] {
    Json const report = read_json(file);
    Gallery gallery{folder, report.at("archive").get<std::string>(), report.at("options"), {}, {}, {}};
    gallery.page = report.value("page", Json::object());
    for (Json const& row : report.at("rows")) {
      if (row.contains("certificate"))
        gallery.models.push_back(read_model(folder, row));
      else
        gallery.left_out.push_back(row.at("input"));
    }
    if (gallery.models.empty())
      throw Error(ErrorKind::invalid_input, "no model of the gallery has a certificate",
                  "convert without --no-certificate");
    return gallery;
  });
}

std::size_t series_bytes(Thumbnail const& thumbnail, std::string_view codec, int frames) {
  auto const found = std::find_if(thumbnail.series.begin(), thumbnail.series.end(),
                                  [&](RivalSeries const& s) { return s.codec == codec && s.frames == frames; });
  return found == thumbnail.series.end() ? 0 : found->bytes;
}

}  // namespace vitrine::report
