// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Few objects: files that need no decoder may weigh less than the decoder saves.

#include <nlohmann/json_fwd.hpp>

#include <filesystem>

namespace vitrine::tools {

/// In:     gallery.json as it will be written, with its page's weight.
/// Out:    where all objects together weigh less as plain files than as they are with the Draco decoder (by gzip):
///         plain.glb beside each thumb.glb, `plain` of each object {glb, bytes} and of the page {thumbnails}. Else
///         plain files of an earlier run go.
/// Errors: those of io::publish_file.
/// Cost:   decodes no more thumbnails than it takes to see that Draco is cheaper: two or three of the usual size.
void offer_plain(std::filesystem::path const& gallery, nlohmann::ordered_json& shown);

}  // namespace vitrine::tools
