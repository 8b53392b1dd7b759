// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What visitors see: the built page, put into a gallery, and what it costs them to load.

#include "graph/report.h"
#include "io/write_glb.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace vitrine::tools {

/// The folder that holds the built page: beside the program as built, or where it is installed; empty where neither is.
std::filesystem::path page_folder();

/// `page`, with a <noscript> of all posters, by name and credit, in place of its line "<!-- posters -->". Names are
/// text.
std::string with_posters(std::string const& page, std::vector<graph::ModelRow> const& rows);

/// Copies the page: index.html to the gallery's root, with its posters, everything else to viewer/; x3dom/ only where
/// thumbnails have X3DOM pages. Says so where this build has none. Errors: those of io::publish_file.
void publish_page(std::filesystem::path const& gallery, std::vector<graph::ModelRow> const& rows, bool x3dom);

/// The key `page` of gallery.json and report.json: bytes of the page's code and, where thumbnails of this profile need
/// one, of its decoder, as they are and by gzip (`sizes`, the page's sizes.json), of all thumbnails and posters, and of
/// the same objects as series of pictures.
nlohmann::ordered_json page_weight(std::filesystem::path const& gallery, std::vector<graph::ModelRow> const& rows,
                                   Profile profile, nlohmann::ordered_json const& sizes);

/// Adds to `page` what tools/page_speed.mjs measured, from the gallery.json that is there, if `page` is else what it
/// was then.
void keep_measured(std::filesystem::path const& gallery, nlohmann::ordered_json& page);

/// sizes.json of the built page; an empty object where there is none.
nlohmann::ordered_json page_sizes();

}  // namespace vitrine::tools
