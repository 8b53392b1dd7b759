// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Moves a mesh onto the grid that the file will store, before anything is baked for it.

#include "stages/data.h"
#include "stages/options.h"

namespace vitrine {

struct QuantizeOptions {
  int position_bits = 11;
  int uv_bits = 11;
  int normal_bits = 8;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(self.position_bits, Field{"position-bits", "bits", "of each stored coordinate", 6, 16});
    visit(self.uv_bits, Field{"uv-bits", "bits", "of each stored texture coordinate", 6, 16});
    visit(self.normal_bits, Field{"normal-bits", "bits", "of each stored normal's two octahedral coordinates", 4, 14});
  }
};

/// Snaps positions and texture coordinates to the values that Draco's explicit quantisation decodes to, bit for bit:
/// origin + i * (range / (2^bits - 1)) in float arithmetic, i the nearest integer.
/// Out:    positions in a cube about the mesh, uvs in the unit square; vertices that meet are one, in the order of
///         their first use; faces that lose their area are dropped, `fill` stays as it was.
/// Errors: LimitExceeded when a step of the uvs is longer than the atlas's gutter, as charts could then overlap;
///         NoSolution when no face is left.
QuantizedAtlas quantize(Atlas atlas, QuantizeOptions const& options = {});

/// The unit vector that Draco's octahedral code of `bits` decodes to for this one, bit for bit.
/// Source: Cigolle et al. 2014, "A Survey of Efficient Representations for Independent Unit Vectors"; the octahedron is
/// unfolded around +X, and has 2^bits - 1 codes a side.
V3f quantize_normal(V3f const& normal, int bits);

}  // namespace vitrine
