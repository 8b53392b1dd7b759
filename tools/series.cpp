// SPDX-License-Identifier: Apache-2.0
#include "tools/series.h"

#include "io/image_codec.h"
#include "stages/clean.h"
#include "stages/letterbox.h"
#include "tools/model_file.h"
#include "tools/printable.h"

#include <fmt/format.h>

#include <array>
#include <string>
#include <utility>

namespace vitrine::tools {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Numbers padded with zeros to one length, so that they compare by value.
std::string sort_key(std::string const& name) {
  constexpr std::size_t width = 20;
  auto const digit = [](unsigned char c) { return std::isdigit(c) != 0; };
  std::string key;
  for (auto at = name.begin(); at != name.end();) {
    auto const end = std::find_if_not(at, name.end(), digit);
    auto const first = std::find_if(at, end, [](char c) { return c != '0'; });
    std::string const number(first, end);
    if (at != end) key += std::string(number.size() < width ? width - number.size() : 0, '0') + number;
    auto const next = std::find_if(end, name.end(), digit);
    key.append(end, next);
    at = next;
  }
  return key;
}

bool is_picture(fs::path const& file) {
  constexpr std::array endings{".jpg", ".jpeg", ".png", ".webp", ".avif", ".tif", ".tiff",
                               ".bmp", ".tga",  ".gif", ".ppm",  ".pgm",  ".pnm"};
  return std::find(endings.begin(), endings.end(), lower_ending(file)) != endings.end();
}

/// Every so many of the files of each row.
std::vector<fs::path> chosen(std::vector<fs::path> const& files, graph::SeriesOptions const& options) {
  std::size_t const rows = std::size_t(options.rows), frames = std::size_t(options.frames);
  std::size_t const row = files.size() / rows;
  if (frames == 0 || files.size() % rows != 0 || row % frames != 0)
    throw Error(ErrorKind::invalid_input, fmt::format("{} pictures are no {} x {} frames", files.size(), rows, frames),
                "supply a multiple of --rows x --frames pictures");
  std::vector<fs::path> result;
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t f = 0; f < frames; ++f) result.push_back(files[r * row + f * (row / frames)]);
  return result;
}

graph::SeriesFiles of_pictures(SeriesCommand const& command) {
  std::vector<fs::path> const files = pictures_in(command.pictures);
  if (files.empty())
    throw Error(ErrorKind::invalid_input, command.pictures.string() + " holds no pictures",
                "name a folder with JPEG, PNG, WebP, AVIF or TIFF files");
  graph::SeriesOptions options = command.series;
  if (command.all_pictures) options.frames = int(files.size()) / options.rows;
  std::vector<Image> frames;
  Json names = Json::array();
  for (fs::path const& file : chosen(files, options)) {
    frames.push_back(of_file(file, [&] {
      return letterbox(io::decode_image(io::map_file(file).bytes, ColourSpace::srgb, command.read.limits),
                       command.measure.size);
    }));
    names.push_back(file.filename().string());
  }
  graph::SeriesFiles made = graph::series_files(frames, options);
  made.manifest["pictures"] = std::move(names);
  return made;
}

graph::SeriesFiles of_model(SeriesCommand const& command) {
  return of_file(command.original, [&] {
    SourceModel source = read_file(command.original, command.read);
    if (command.up == io::UpAxis::z) io::turn_z_up(source);
    SurveyedModel const original =
        survey(std::make_shared<SourceModel const>(clean(std::move(source)).model), occlusion_rays(command.measure));
    Reference const made = reference(original, command.measure);
    graph::SeriesFiles files = graph::series_files(original, made, command.series);
    files.manifest["input"] = command.original.filename().string();
    files.manifest["light"] = made.options.light == Light::head ? "head" : "side";
    return files;
  });
}

std::string kilobytes(Json const& bytes) { return fmt::format("{:.1f} KB", bytes.get<double>() / 1000); }

void print_summary(SeriesCommand const& command, Json const& manifest) {
  fs::path const& source = command.pictures.empty() ? command.original : command.pictures;
  fmt::print("{}: {} x {} frames of {} pixels, {} of quality {}\n", printable(source.string()),
             manifest["rows"].get<int>(), manifest["frames"].get<int>(), manifest["size"].get<int>(),
             manifest["codec"].get<std::string>(), manifest["quality"].get<int>());
  fmt::print("{:<26}{:>12}{}\n", "frames", kilobytes(manifest["bytes"]),
             manifest.contains("files") ? "" : "  (not written)");
  for (char const* part : {"sheet", "animation"})
    if (manifest.contains(part)) fmt::print("{:<26}{:>12}\n", part, kilobytes(manifest[part]["bytes"]));
  fmt::print("{:<26}{:>12.3f}\n", "coding, MSE x 10^4", manifest["codingMse1e4"].get<double>());
  if (manifest.contains("turningMse1e4"))
    fmt::print("{:<26}{:>12.3f}\n", "turning, MSE x 10^4", manifest["turningMse1e4"].get<double>());
  fmt::print("written: {}\n", printable((command.out / "series.json").string()));
}

}  // namespace

void take_paper_series(SeriesCommand& command, int frames, std::function<bool(char const* flag)> const& given) {
  auto const unless_given = [&](char const* flag, auto& value, auto paper) {
    if (!given(flag)) value = paper;
  };
  unless_given("--frames", command.series.frames, frames);
  unless_given("--rows", command.series.rows, 1);
  unless_given("--codec", command.series.codec, SeriesCodec::jpeg);
  unless_given("--size", command.measure.size, 200);
}

std::vector<fs::path> pictures_in(fs::path const& folder) {
  std::vector<fs::path> files;
  for (fs::directory_entry const& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file() && is_picture(entry.path())) files.push_back(entry.path());
  std::sort(files.begin(), files.end(), [](fs::path const& a, fs::path const& b) {
    std::string const x = a.filename().string(), y = b.filename().string();
    return std::pair(sort_key(x), x) < std::pair(sort_key(y), y);
  });
  return files;
}

int series(SeriesCommand const& command) {
  if (!command.pictures.empty() && fs::weakly_canonical(command.pictures) == fs::weakly_canonical(command.out))
    throw Error(ErrorKind::invalid_input, "--from and --out are the same folder", "name another folder for the series");
  graph::SeriesFiles const made = command.pictures.empty() ? of_model(command) : of_pictures(command);
  graph::publish_series(command.out, made);
  if (command.json)
    fmt::print("{}\n", made.manifest.dump(1, ' ', false, Json::error_handler_t::replace));
  else
    print_summary(command, made.manifest);
  return 0;
}

}  // namespace vitrine::tools
