// SPDX-License-Identifier: Apache-2.0
#include "tools/plain_page.h"

#include "io/blob.h"
#include "io/plain_glb.h"
#include "io/publish.h"
#include "stages/error.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>
#include <system_error>
#include <vector>

namespace vitrine::tools {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Files = std::vector<std::vector<std::byte>>;

fs::path plain_path(Json const& object) {
  return fs::path(object.at("thumb").get<std::string>()).replace_filename("plain.glb");
}

/// All objects as plain files; none where these weigh more than `spared` bytes above what there is, or a thumbnail is
/// damaged: that is for others to tell.
Files cheaper_files(fs::path const& gallery, Json const& objects, std::size_t spared) try {
  Files files;
  std::size_t plain = 0, coded = 0;
  for (Json const& object : objects) {
    files.push_back(io::plain_glb(io::map_file(gallery / object.at("thumb").get<std::string>()).bytes));
    plain += files.back().size();
    coded += object.at("bytes").get<std::size_t>();
    if (files.back().empty() || plain >= coded + spared) return {};
  }
  return files;
} catch (Error const&) {
  return {};
}

}  // namespace

void offer_plain(fs::path const& gallery, Json& shown) {
  Json &objects = shown.at("objects"), &page = shown.at("page");
  std::size_t const decoder = page.contains("decoder") ? page["decoder"].at("gzip").get<std::size_t>() : 0;
  Files const files = cheaper_files(gallery, objects, decoder);
  std::size_t total = 0;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    fs::path const path = plain_path(objects[i]);
    if (files.empty()) {
      std::error_code kept;
      fs::remove(gallery / path, kept);
      continue;
    }
    io::publish_file(gallery / path, files[i]);
    objects[i]["plain"] = {{"glb", path.string()}, {"bytes", files[i].size()}};
    total += files[i].size();
  }
  if (!files.empty()) page["plain"] = {{"thumbnails", total}};
}

}  // namespace vitrine::tools
