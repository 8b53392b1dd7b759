// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The thumbnail's file: GLB 2.0, clean in the Khronos validator.

#include "io/image_codec.h"
#include "stages/data.h"
#include "stages/options.h"

#include <string_view>

namespace vitrine {

enum class Profile {
  web,     ///< Draco geometry, WebP maps (JPEG where halved chroma would show)
  plain,   ///< no decoder needed: quantised buffers, JPEG colour, PNG normals
  meshopt  ///< EXT_meshopt_compression geometry, maps as for web
};
template <>
struct EnumNames<Profile> {
  static constexpr std::array<std::string_view, 3> names{"web", "plain", "meshopt"};
};

namespace io {

struct EncodeOptions {
  Profile profile = Profile::web;
  int colour_quality = 80;
  int normal_quality = 60;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(self.profile, Field{"profile", "", "what a client must be able to decode"});
    visit(self.colour_quality, Field{"colour-quality", "of 100", "of the coded colour map", 1, 100});
    visit(self.normal_quality, Field{"normal-quality", "of 100", "of the coded normal map; plain stores it without loss", 1, 100});
  }
};

/// Out:    a GLB with one mesh of one primitive, non-metallic and rough, maps embedded; extensionsRequired says what it needs;
///         `title` becomes the node's name when not empty.
/// Errors: Broken if a codec fails on a valid model.
EncodedThumbnail encode(BakedModel const& model, std::string_view title, EncodeOptions const& options = {});

}  // namespace io
}  // namespace vitrine
