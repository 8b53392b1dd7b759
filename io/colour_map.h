// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A thumbnail's colour or occlusion map as bytes: at a quality, or in so many bytes. Internal to io.

#include "io/write_glb.h"

#include <optional>

namespace vitrine::io {

struct CodedColour {
  EncodedImage image;
  int quality = 0;  ///< of 100
};

/// None for `automatic`.
std::optional<ImageCodec> codec_asked_for(MapCodec codec);

/// As the profile says, or as JPEG where that comes nearer in no more bytes (map_codec.h); a codec that is asked for is
/// used as it is.
CodedColour code_colour(Image const& map, EncodeOptions const& options);

/// At the highest quality, 5 to 95, whose bytes fit into `room`, to one part in forty (a draft: in sixteen); at the
/// lowest where none does.
/// The search begins at the options' own quality.
CodedColour code_colour_within(std::size_t room, Image const& map, EncodeOptions const& options);

}  // namespace vitrine::io
