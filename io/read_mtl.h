// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Wavefront material libraries. Internal to io.

#include "io/textures.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vitrine::io {

/// A texture as an MTL names it, with the options that change how it is laid on.
struct MtlTexture {
  std::string file;                    ///< empty: none
  std::array<double, 2> scale{1, 1};   ///< -s
  std::array<double, 2> offset{0, 0};  ///< -o
  bool clamp = false;                  ///< -clamp on
};

struct MtlMaterial {
  std::string name;
  std::optional<std::array<double, 3>> kd;  ///< sRGB, in [0,1]
  double opacity = 1;                       ///< d, or 1 - Tr
  MtlTexture colour_map, normal_map;        ///< map_Kd, norm
};

/// Materials in the file's order. What a viewer might show and thumbnails do not (bump, map_d, map_Ke) is noted.
std::vector<MtlMaterial> parse_mtl(std::string_view text, std::vector<std::string>& notes);

/// What is drawn for it. Without a colour of its own it is MTL's grey of 0.8, or white where vertices have colours.
/// Kd beside a map_Kd: see MtlKd; black there is never meant.
Material to_material(MtlMaterial const& source, bool vertex_colours, MtlKd mtl_kd, Textures& textures,
                     Resolve const& resolve, std::vector<std::string>& notes);

}  // namespace vitrine::io
