// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The thumbnail's file: GLB 2.0, clean in the Khronos validator.

#include "io/image_codec.h"
#include "stages/data.h"
#include "stages/options.h"

#include <cstddef>
#include <limits>
#include <string_view>

namespace vitrine {

enum class Profile {
  web,      ///< Draco geometry, WebP maps (JPEG where halved chroma would show)
  plain,    ///< no decoder needed: quantised buffers, JPEG colour, PNG normals
  meshopt,  ///< EXT_meshopt_compression geometry, maps as for web
  core      ///< glTF 2.0 alone: geometry as floats, maps as for plain; for importers that know no extensions
};
template <>
struct EnumNames<Profile> {
  static constexpr std::array<std::string_view, 4> names{"web", "plain", "meshopt", "core"};
};

/// Whether maps are JPEG and PNG alone.
constexpr bool common_maps(Profile profile) { return profile == Profile::plain || profile == Profile::core; }

/// How a map is stored. A map with alpha is never JPEG: PNG takes its place.
enum class MapCodec {
  automatic,  ///< as the profile says
  webp,
  avif,
  jpeg,
  png
};
template <>
struct EnumNames<MapCodec> {
  static constexpr std::array<std::string_view, 5> names{"auto", "webp", "avif", "jpeg", "png"};
};

namespace io {

struct EncodeOptions {
  Profile profile = Profile::web;
  MapCodec colour_codec = MapCodec::automatic;  ///< also of occlusion
  MapCodec normal_codec = MapCodec::automatic;
  int colour_quality = 80;
  int normal_quality = 60;
  bool x3dom = false;
  // What the search decides; no users' options:
  bool full_chroma = false;  ///< AVIF: 4:4:4 instead of 4:2:0
  bool draft = false;        ///< one of many: AVIF takes a fifth of the time, and the map 94 % of its room

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(self.profile, Field{"profile", "", "what a client must be able to decode"});
    visit(self.colour_codec, Field{"colour-codec", "", "of the colour and occlusion maps; auto: as the profile says"});
    visit(self.normal_codec, Field{"normal-codec", "", "of the normal map; auto: as the profile says"});
    visit(self.colour_quality, Field{"colour-quality", "of 100", "of the coded colour map", 1, 100});
    visit(self.normal_quality, Field{"normal-quality", "of 100",
                                     "of the coded normal map; PNG, and so plain, stores it without loss", 1, 100});
    visit(self.x3dom,
          Field{"x3dom", "", "write each thumbnail for X3DOM too: a page, its buffers and maps, and a zip of them"});
  }
};

/// The normal map as every file of a thumbnail holds it: as the profile says, or as JPEG where that comes nearer in no
/// more bytes (map_codec.h); a codec that is asked for is used as it is, with full chroma where it can.
EncodedImage encode_normal(Image const& map, EncodeOptions const& options);

inline constexpr std::size_t kAnySize = std::numeric_limits<std::size_t>::max();

/// In:     `most_bytes`: the colour map gets the highest quality (5 to 95) at which the file is no larger; else the
///         quality that the options name.
/// Out:    a GLB with one mesh of one primitive, non-metallic and rough, maps embedded; extensionsRequired says what it
///         needs; `title` becomes the node's name when not empty.
/// Errors: Broken if a codec fails on a valid model.
EncodedThumbnail encode(BakedModel const& model, std::string_view title, EncodeOptions const& options = {},
                        std::size_t most_bytes = kAnySize);

}  // namespace io
}  // namespace vitrine
