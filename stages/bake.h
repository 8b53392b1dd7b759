// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Transfers the original's colours and normals into the atlas's textures.
/// Source: Sander et al. 2001 and Cignoni et al. 1998 (normal shooting); Limper et al. 2015, section 3.3.

#include "stages/data.h"
#include "stages/occlusion.h"
#include "stages/options.h"
#include "stages/surface.h"

namespace vitrine {

enum class Transfer {
  normal,  ///< along the normal, outwards and inwards: normal shooting
  nearest  ///< from the closest point, whichever way it faces: what the paper compares that with
};
template <>
struct EnumNames<Transfer> {
  static constexpr std::array<std::string_view, 2> names{"normal", "nearest"};
};

struct BakeOptions {
  int samples = 9;  ///< per texel; a square number
  Transfer transfer = Transfer::normal;
  double reach = 0.05;  ///< how far normals shoot, as a share of the bounding box's diagonal
  bool normal_map = true;
  bool vertex_normals = true;
  Occlusion occlusion = Occlusion::none;
  int occlusion_rays = kOcclusionRays;
  bool derived_normals =
      false;  ///< also a normal map for clients that build the frame without TANGENT; no flag: X3DOM needs it

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(self.samples, Field{"samples", "per texel", "rounded up to a square number", 1, 256});
    visit(self.transfer, Field{"transfer", "",
                               "where a sample's colour and normal come from: along its normal, or the nearest point"});
    visit(self.reach, Field{"reach", "box diagonals", "how far rays look for the original", 1e-4, 1});
    visit(self.normal_map, Field{"normal-map", "", "bake the original's normals"});
    visit(self.vertex_normals,
          Field{"vertex-normals", "",
                "store smooth normals, as a normal map needs anyway; without them clients draw facets"});
    visit(self.occlusion,
          Field{"ao", "", "ambient occlusion for models without colour: as glTF occlusion, or as grey colour"});
    visit(self.occlusion_rays, Field{"ao-rays", "rays", "from each place of the original, see --ao", 4, 4096});
  }
};

/// Shoots each sample (unless options.transfer says otherwise) along the interpolated normal, outwards and inwards, and
/// takes the nearer hit on a face whose normal agrees (dot > 0), so that the far side of a sheet never counts; where
/// there is none, the closest point of agreeing orientation within reach, then any closest point. Colours are averaged
/// in linear light, weighted by their coverage.
///
/// Out:    vertex normals for the quantised mesh, as the client decodes them; maps as large as the atlas, in which
///         every texel that a client reads for a point of a chart has its values, and the rest is filled smoothly.
///         No colour map for models of one colour or none; occlusion as the survey traced it; alpha only where
///         something is transparent; normals in the frame of the chart's tangent, which goes with them
///         (tangent_frame.h), none for unlit models. Double-sided if the original is, or the mesh has a boundary. The
///         same bytes at any thread count.
/// Cost:   two rays a sample, tiles of the texture in parallel; 12 floats a texel at most.
BakedModel bake(QuantizedAtlas const& target, SurveyedModel const& original, BakeOptions const& options = {});

}  // namespace vitrine
