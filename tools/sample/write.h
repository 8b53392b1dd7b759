// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Scans to files, in blocks: beyond the scan itself no memory grows with the triangles (the order of a shuffled PLY
/// apart). Errors of all: std::ios_base::failure when the disk refuses; LimitExceeded beyond what a format can count.

#include "io/image_codec.h"
#include "tools/sample/objects.h"

#include <filesystem>
#include <optional>

namespace vitrine::sample {

/// `shuffle`: seed of a random order of vertices and faces, as merged scans have it.
void write_ply(std::filesystem::path const& path, Scan const& scan, Format encoding, bool coloured,
               std::optional<std::uint32_t> shuffle = {});
void write_stl(std::filesystem::path const& path, Scan const& scan);
void write_off(std::filesystem::path const& path, Scan const& scan);
/// With a texture, also NAME.mtl and the image beside it.
void write_obj(std::filesystem::path const& path, Scan const& scan, Colour colour);
void write_glb(std::filesystem::path const& path, Scan const& scan, Colour colour);

/// The paint as an image file (JPEG or PNG), as wide as the triangles deserve: 256 to 4096 texels.
io::EncodedImage encode_texture(Scan const& scan, Colour colour);

/// The file name's ending of a format, with the dot.
std::string_view ending(Format format);

/// Writes the object in its own format below its own folder of `root`; the path relative to `root`.
std::filesystem::path write(std::filesystem::path const& root, Object const& object, std::string const& name,
                            Scan const& scan, std::optional<std::uint32_t> shuffle = {});

}  // namespace vitrine::sample
