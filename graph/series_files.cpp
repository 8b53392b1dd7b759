// SPDX-License-Identifier: Apache-2.0
#include "graph/series_files.h"

#include "io/blob.h"
#include "io/publish.h"
#include "io/webp_animation.h"
#include "stages/error.h"
#include "stages/series.h"

#include <algorithm>
#include <set>

namespace vitrine::graph {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int kMostPictures = 1024, kSheetColumns = 8, kRevolution = 4000;  // milliseconds once round

int count(SeriesOptions const& options) { return options.frames * options.rows; }

int sheet_columns(SeriesOptions const& options) { return std::min(count(options), kSheetColumns); }

int largest_side(SeriesCodec codec) {
  return codec == SeriesCodec::jpeg ? 65500 : codec == SeriesCodec::webp ? 16383 : 32768;
}

/// Before anything is drawn or coded.
void require_possible(SeriesOptions const& options, int size) {
  if (count(options) > kMostPictures)
    throw Error(ErrorKind::limit_exceeded,
                "a series of " + std::to_string(options.rows) + " x " + std::to_string(options.frames) +
                    " frames; the limit is " + std::to_string(kMostPictures),
                "take fewer frames or rows");
  int const columns = sheet_columns(options), lines = (count(options) + columns - 1) / columns;
  int const longest = size * std::max(columns, lines), most = largest_side(options.codec);
  if (options.sheet && longest > most)
    throw Error(ErrorKind::limit_exceeded,
                "a sheet of " + std::to_string(longest) + " pixels; " + name_of(options.codec) +
                    " images have at most " + std::to_string(most),
                "take fewer or smaller frames, or another --codec");
}

int quality_of(SeriesOptions const& options) {
  return options.quality > 0 ? options.quality : usual_quality(options.codec);
}

std::string ending(SeriesCodec codec) { return codec == SeriesCodec::jpeg ? ".jpg" : "." + name_of(codec); }

/// "frame-00-07.jpg"; more digits where there are more than a hundred.
std::string frame_name(int row, int frame, SeriesOptions const& options) {
  auto const padded = [](int number, int most) {
    std::string const digits = std::to_string(number);
    std::size_t const width = std::max<std::size_t>(2, std::to_string(most - 1).size());
    return std::string(width - digits.size(), '0') + digits;
  };
  return "frame-" + padded(row, options.rows) + "-" + padded(frame, options.frames) + ending(options.codec);
}

// ---- The parts of a series: each adds its files and what series.json says of them -----------------------------------

void add_frames(std::vector<std::vector<std::byte>> coded, SeriesOptions const& options, SeriesFiles& series) {
  std::size_t bytes = 0;
  Json list = Json::array();
  for (int i = 0; i < count(options); ++i) {
    int const row = i / options.frames, frame = i % options.frames;
    std::string const name = frame_name(row, frame, options);
    bytes += coded[std::size_t(i)].size();
    list.push_back({{"file", name}, {"row", row}, {"frame", frame}, {"bytes", coded[std::size_t(i)].size()}});
    if (options.single) series.files.push_back({name, std::move(coded[std::size_t(i)])});
  }
  series.manifest["bytes"] = bytes;
  if (options.single) series.manifest["files"] = std::move(list);
}

void add_sheet(std::vector<Image> const& pictures, SeriesOptions const& options, SeriesFiles& series) {
  int const columns = sheet_columns(options);
  Image const sheet = sprite_sheet(pictures, columns);
  std::vector<std::byte> coded = io::encode_image(sheet, coding(options.codec, quality_of(options))).bytes;
  std::string const name = "sheet" + ending(options.codec);
  series.manifest["sheet"] = {
      {"file", name}, {"columns", columns}, {"width", sheet.width}, {"height", sheet.height}, {"bytes", coded.size()}};
  series.files.push_back({name, std::move(coded)});
}

void add_animation(std::vector<Image> const& pictures, SeriesOptions const& options, SeriesFiles& series) {
  int const milliseconds = std::max(20, kRevolution / options.frames);
  int const quality = options.codec == SeriesCodec::webp ? quality_of(options) : usual_quality(SeriesCodec::webp);
  std::vector<Image> const row(pictures.begin(), pictures.begin() + options.frames);
  std::vector<std::byte> coded = io::encode_animation(row, quality, milliseconds);
  series.manifest["animation"] = {
      {"file", "turn.webp"}, {"row", 0}, {"milliseconds", milliseconds}, {"quality", quality}, {"bytes", coded.size()}};
  series.files.push_back({"turn.webp", std::move(coded)});
}

/// What is known of every series, whatever its pictures show.
Json head(SeriesOptions const& options, int size) {
  return {{"schema", 1},          {"frames", options.frames},        {"rows", options.rows},
          {"size", size},         {"codec", name_of(options.codec)}, {"quality", quality_of(options)},
          {"order", "row by row"}};
}

/// Whoever views the object from the reference's cameras sees the nearest frame.
double turning_error(Reference const& reference, std::vector<Image> const& decoded, SeriesOptions const& options) {
  std::vector<Showing> const showings =
      nearest_frames(directions(reference.options.views, int(reference.pictures.size())),
                     series_directions(options.frames, options.rows));
  return mse1e4(reference.pictures, decoded, showings);
}

/// `more(manifest, decoded)` says what is known beyond the pictures themselves.
template <class More>
SeriesFiles make(std::vector<Image> const& pictures, SeriesOptions const& options, More const& more) {
  CodedFrames coded = code_frames(pictures, coding(options.codec, quality_of(options)));
  SeriesFiles series;
  series.manifest = head(options, pictures.front().width);
  std::vector<Showing> own;
  for (std::size_t i = 0; i < pictures.size(); ++i) own.push_back({i, i});
  series.manifest["codingMse1e4"] = mse1e4(pictures, coded.decoded, own);
  more(series.manifest, coded.decoded);
  add_frames(std::move(coded.files), options, series);
  if (options.sheet) add_sheet(pictures, options, series);
  if (options.animated) add_animation(pictures, options, series);
  return series;
}

// ---- Pictures of a model --------------------------------------------------------------------------------------------

/// The frames as the reference has them, if it looks from there.
std::vector<Image> drawn_before(Reference const& reference, SeriesOptions const& options) {
  std::size_t const views = reference.pictures.size(), frames = std::size_t(options.frames);
  std::vector<Image> pictures;
  if (reference.options.views == ViewSet::turntable && options.rows == 1 && views >= frames && views % frames == 0)
    for (std::size_t i = 0; i < frames; ++i) pictures.push_back(reference.pictures[i * (views / frames)]);
  return pictures;
}

std::vector<Image> draw(SurveyedModel const& original, Reference const& reference, SeriesOptions const& options) {
  std::vector<Camera> cameras;
  for (V3d const& direction : series_directions(options.frames, options.rows))
    cameras.push_back(camera(reference.sphere, direction));
  return draw_original(original, cameras, reference);
}

// ---- Files ----------------------------------------------------------------------------------------------------------

/// Whether a series can have written it: series.json may be anybody's.
bool is_ours(std::string const& name) {
  return name.find('/') == std::string::npos &&
         (name.starts_with("frame-") || name.starts_with("sheet.") || name == "turn.webp");
}

/// The files that the series.json of an earlier series names.
std::set<std::string> files_named(fs::path const& manifest) {
  std::set<std::string> names;
  if (!fs::exists(manifest)) return names;
  io::Blob const file = io::map_file(manifest);
  Json const json = Json::parse(io::text(file), nullptr, false);
  auto const take = [&](Json const& item) {
    if (!item.is_object() || !item.contains("file") || !item["file"].is_string()) return;
    std::string const name = item["file"];
    if (is_ours(name)) names.insert(name);
  };
  if (!json.is_object()) return names;
  for (char const* part : {"sheet", "animation"})
    if (json.contains(part)) take(json[part]);
  if (json.contains("files") && json["files"].is_array())
    for (Json const& item : json["files"]) take(item);
  return names;
}

}  // namespace

SeriesFiles series_files(SurveyedModel const& original, Reference const& reference, SeriesOptions const& options) {
  require_possible(options, reference.options.size);
  std::vector<Image> pictures = drawn_before(reference, options);
  if (pictures.empty()) pictures = draw(original, reference, options);
  return make(without_alpha(pictures), options, [&](Json& manifest, std::vector<Image> const& decoded) {
    if (reference.options.views == ViewSet::turntable && !reference.pictures.empty())
      manifest["turningMse1e4"] = turning_error(reference, decoded, options);
    manifest["elevations"] = row_elevations(options.rows);
    manifest["firstAzimuth"] = 0;
    manifest["direction"] = "counterclockwise";
  });
}

SeriesFiles series_files(std::vector<Image> const& pictures, SeriesOptions const& options) {
  if (pictures.empty() || int(pictures.size()) != count(options))
    throw Error(ErrorKind::invalid_input,
                std::to_string(pictures.size()) + " pictures are no " + std::to_string(options.rows) + " x " +
                    std::to_string(options.frames) + " frames",
                "supply as many pictures as --rows x --frames");
  require_possible(options, pictures.front().width);
  return make(pictures, options, [](Json&, std::vector<Image> const&) {});
}

void publish_series(fs::path const& folder, SeriesFiles const& series) {
  fs::path const manifest = folder / "series.json";
  std::set<std::string> left_over = files_named(manifest);
  for (SeriesFile const& file : series.files) {
    io::publish_file(folder / file.name, file.bytes);
    left_over.erase(file.name);
  }
  io::publish_file(manifest, series.manifest.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
  std::error_code ignored;
  for (std::string const& name : left_over) fs::remove(folder / name, ignored);
}

}  // namespace vitrine::graph
