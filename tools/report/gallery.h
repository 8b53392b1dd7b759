// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a gallery says of its own models: report.json and the certificates, as values.

#include "graph/strict_json.h"
#include "stages/verdict.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace vitrine::report {

using Json = graph::StrictOrderedJson;

/// One thumbnail as its certificate has it. Errors are MSE x 10^4.
struct Thumbnail {
  std::size_t bytes = 0, geometry = 0, colour = 0, normal = 0, occlusion = 0, other = 0;
  std::size_t delivered = 0;  ///< of the zip for X3DOM where there is one, as the paper counts; else bytes
  double mse1e4 = 0, ssim = 0;
  double coverage = 0;  ///< share of the pictures that the original covers
  std::size_t worst_view = 0;
  std::uint32_t triangles = 0;
  std::vector<RivalSeries> series;
};

struct Model {
  std::string input;  ///< path in the archive
  std::string title;
  std::string slug;  ///< name of its folder: [a-z0-9-]
  std::string up;    ///< axis that points up in the original: "y" or "z"
  bool coloured = false;
  std::uint64_t bytes = 0, triangles = 0;  ///< of the original
  Thumbnail thumbnail;
  Json certificate;
};

struct Gallery {
  std::filesystem::path folder;
  std::filesystem::path archive;      ///< where the originals are
  Json options;                       ///< that it was made with
  std::vector<Model> models;          ///< those that have a certificate, in the archive's order
  std::vector<std::string> left_out;  ///< inputs of the others
  Json page = Json::object();         ///< what report.json says of the page's bytes
};

/// Errors: InvalidInput, naming the key, where something is missing or of another kind.
Thumbnail read_thumbnail(Json const& certificate);

/// Errors: InvalidInput when the folder is no gallery, a file is damaged or of another schema, or nothing was measured.
Gallery read_gallery(std::filesystem::path const& folder);

/// A JSON file of ours. Errors: InvalidInput, naming the file.
Json read_json(std::filesystem::path const& file);

/// The size of this series in bytes; 0 if it was not made.
std::size_t series_bytes(Thumbnail const& thumbnail, std::string_view codec, int frames);

}  // namespace vitrine::report
