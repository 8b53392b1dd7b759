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

/// Out:    positions at origin + i * range / (2^bits - 1) in a cube about the mesh, uvs at i / (2^bits - 1): the values
///         that Draco's explicit quantisation decodes to, bit for bit. Faces that lose their area are dropped.
QuantizedAtlas quantize(Atlas atlas, QuantizeOptions const& options = {});

}  // namespace vitrine
