// SPDX-License-Identifier: Apache-2.0
#include "graph/preset.h"

#include <utility>

namespace vitrine::graph {
namespace {

/// Triangles: what is taken wherever nothing is searched for, so that a comparison is one of methods. `plain` holds the
/// same 16-bit values as X3DOM's binary geometry.
ModelOptions paper(ModelOptions options) {
  options.simplify.triangles = 3000;
  options.simplify.decimator = Decimator::openmesh;
  options.cluster.above = 2'000'000'000;
  options.pack.texture = 256;
  options.pack.packing = Packing::boxes;
  options.quantize.position_bits = 16;
  options.quantize.uv_bits = 16;
  options.bake.samples = 1;
  options.bake.transfer = Transfer::normal;
  options.bake.normal_map = true;
  options.bake.occlusion = Occlusion::colour;
  options.encode.profile = Profile::plain;
  options.encode.colour_codec = MapCodec::jpeg;
  options.encode.colour_quality = 90;
  options.encode.normal_codec = MapCodec::png;
  options.encode.x3dom = true;
  return options;
}

}  // namespace

ModelOptions with(Preset preset, ModelOptions options) {
  switch (preset) {
    case Preset::paper:
      return paper(std::move(options));
  }
  return options;
}

}  // namespace vitrine::graph
