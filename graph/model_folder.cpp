// SPDX-License-Identifier: Apache-2.0
#include "graph/model_folder.h"

#include "io/dependencies.h"
#include "io/publish.h"

#include <vector>

namespace vitrine::graph {
namespace {

namespace fs = std::filesystem;

constexpr char kCertificate[] = "certificate.json";

}  // namespace

ModelFolder::ModelFolder(fs::path const& gallery, ModelRow& row)
    : gallery_(gallery), folder_(fs::path("models") / row.slug), row_(row) {
  io::withdraw_file(gallery_ / folder_ / kCertificate);
  row_.files.clear();
}

void ModelFolder::write(std::string const& name, std::span<std::byte const> bytes) {
  io::publish_file(gallery_ / folder_ / name, bytes);
  row_.files[folder_ / name] = io::content_hash(bytes);
}

void ModelFolder::enter(std::string const& name) {
  row_.files[folder_ / name] = io::content_hash(io::map_file(gallery_ / folder_ / name).bytes);
}

void ModelFolder::settle() {
  std::vector<fs::path> left_over;
  for (fs::directory_entry const& entry : fs::recursive_directory_iterator(gallery_ / folder_))
    if (!entry.is_directory() && !row_.files.contains(fs::relative(entry.path(), gallery_)))
      left_over.push_back(entry.path());
  for (fs::path const& file : left_over) {
    fs::remove(file);
    for (fs::path up = file.parent_path(); up != gallery_ / folder_ && fs::is_empty(up); up = up.parent_path())
      fs::remove(up);
  }
  name_files(row_);
}

void ModelFolder::certify(std::string_view text) {
  write(kCertificate, std::as_bytes(std::span(text)));
  name_files(row_);
}

void name_files(ModelRow& row) {
  std::string const folder = "models/" + row.slug + "/";
  auto const published = [&](std::string const& name) {
    return row.files.contains(folder + name) ? folder + name : "";
  };
  row.thumb = published("thumb.glb");
  row.poster = published("poster.jpg");
  row.certificate = published(kCertificate);
  row.x3d = published("x3d/index.html");
  row.x3d_zip = published("thumb.x3d.zip");
  row.series_folder = published("series/series.json").empty() ? "" : folder + "series";
}

}  // namespace vitrine::graph
