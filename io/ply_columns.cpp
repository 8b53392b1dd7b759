// SPDX-License-Identifier: Apache-2.0
#include "io/ply_columns.h"

namespace vitrine::io {

std::optional<PlyColour> PlyColour::of(PlyElement const& element) {
  auto const columns = ply_columns<3>(
      element, {{{"red", "r", "diffuse_red"}, {"green", "g", "diffuse_green"}, {"blue", "b", "diffuse_blue"}}});
  if (!columns) return std::nullopt;
  PlyType const type = element.properties[columns->front()].type;
  if (type == PlyType::float32 || type == PlyType::float64) return PlyColour{*columns, 1};
  return PlyColour{*columns, type == PlyType::uint16 ? 65535.0 : 255.0};
}

}  // namespace vitrine::io
