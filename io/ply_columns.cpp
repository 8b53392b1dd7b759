// SPDX-License-Identifier: Apache-2.0
#include "io/ply_columns.h"

#include "io/colour.h"

#include <algorithm>
#include <cmath>

namespace vitrine::io {

std::optional<PlyColumns<3>> ply_colour_columns(PlyElement const& element) {
  return ply_columns<3>(
      element, {{{"red", "r", "diffuse_red"}, {"green", "g", "diffuse_green"}, {"blue", "b", "diffuse_blue"}}});
}

std::optional<Rgba16> ply_colour(PlyElement const& element, PlyColumns<3> const& columns,
                                 std::array<double, 3> const& rgb) {
  Rgba16 rgba{0, 0, 0, 65535};
  for (std::size_t k = 0; k < 3; ++k) {
    if (!std::isfinite(rgb[k])) return std::nullopt;
    switch (element.properties[columns[k]].type) {
      case PlyType::float32:
      case PlyType::float64:
        rgba[k] = linear16(rgb[k]);
        break;
      case PlyType::uint16:
        rgba[k] = linear16(rgb[k] / 65535);
        break;
      default:
        rgba[k] = linear16(static_cast<std::uint8_t>(std::clamp(rgb[k], 0.0, 255.0)));
    }
  }
  return rgba;
}

}  // namespace vitrine::io
