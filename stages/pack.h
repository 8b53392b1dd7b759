// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Places flat charts in one texture.
/// Source: Levy et al. 2002, section 5 (horizons); real shapes instead of horizons as in later packers.

#include "stages/data.h"
#include "stages/options.h"

namespace vitrine {

enum class Packing {
  shapes,  ///< rasterised outlines, several rotations, largest first
  boxes    ///< bounding rectangles on shelves: the paper's
};
template <>
struct EnumNames<Packing> {
  static constexpr std::array<std::string_view, 2> names{"shapes", "boxes"};
};

struct PackOptions {
  int texture = 256;
  int gutter = 2;
  Packing packing = Packing::shapes;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(self.texture,
          Field{"texture", "texels", "width and height of the texture atlas; 0: the search decides", 0, 8192});
    visit(self.gutter, Field{"gutter", "texels", "kept free between any two charts", 1, 64});
    visit(self.packing, Field{"packing", "", "by the charts' real shapes, or by bounding boxes as in the paper"});
  }
};

/// In:     flat charts; all are scaled by one common factor, the largest at which everything fits.
/// Out:    uv in [0,1]; each chart moved, rotated and scaled only; any two charts at least `gutter` texels apart, and
///         half a gutter from the edge; every texel whose square a chart touches belongs to that chart alone.
/// Errors: LimitExceeded when the charts do not fit even at one texel each (more charts than texels allow).
/// Cost:   O(charts * texels / 64) for each trial scale; above 640 x 640 texels that of so many squares.
Atlas pack(FlatCharts const& charts, PackOptions const& options = {});

}  // namespace vitrine
