// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The thumbnail as X3DOM shows it: the paper's delivery format.
/// Source: Behr et al. 2012, "Using Images and Explicit Binary Container for Efficient and Incremental Delivery of
/// Declarative 3D Scenes on the Web" (BinaryGeometry).

#include "io/write_glb.h"
#include "stages/data.h"

#include <string_view>
#include <vector>

namespace vitrine::io {

/// Where the page looks for X3DOM: in the gallery's viewer folder, from a folder of the model's folder.
inline constexpr std::string_view kX3domScript = "../../../viewer/x3dom/x3dom.js";

/// In:     as for encode; with a normal map also model.derived_normal.
/// Out:    index.html, a page that shows one BinaryGeometry and fits any frame; beside it coord.bin and texcoord.bin
///         (16 bits; position = corner of the grid's cube + integer / 65535 of its side, exact when the grid has 16
///         bits, else within half a step), normal.bin (8 bits), colour.bin (16 bits), index.bin (16 bits, 32 above
///         65535 vertices), and the maps, coded as in the GLB. No occlusion map: X3DOM's materials with 16-bit geometry
///         have none.
/// Errors: as for encode.
std::vector<NamedFile> write_x3d(BakedModel const& model, std::string_view title, EncodeOptions const& options);

}  // namespace vitrine::io
