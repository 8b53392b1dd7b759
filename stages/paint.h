// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A whole thumbnail without an atlas: the light mesh in colours per vertex, flat or with normals per vertex.

#include "stages/options.h"
#include "stages/quantize.h"
#include "stages/surface_samples.h"

namespace vitrine {

struct PaintOptions {
  bool swatches = false;
  bool palette = true;
  int colour_bits = 5;
  double smoothing = 0.1;
  bool normals = false;
  bool creases = false;
  int normal_bits = 6;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(self.swatches, Field{"swatches", "", "give each face one of the few colours of an original in flat ones"});
    visit(self.palette,
          Field{"palette", "", "colours per vertex as places in a small palette, not as red, green and blue"});
    visit(self.colour_bits, Field{"colour-bits", "bits", "of each number of a colour per vertex", 3, 8});
    visit(self.smoothing,
          Field{"colour-smoothing", "",
                "colours per vertex: 0 fits the original best, 1 takes the mean around the vertex, which packs better",
                0, 10});
    visit(self.normals, Field{"smooth", "", "store normals per vertex; without them clients draw facets"});
    visit(self.creases, Field{"creases", "", "store one normal for each side of the original's creases"});
    visit(self.normal_bits, Field{"smooth-bits", "bits", "of each stored normal's two octahedral coordinates", 4, 14});
  }
};

/// Fits colours and normals to the samples, see vertex_fit.h. Colours are fitted in sRGB, in which pictures are
/// compared.
///
/// In:     the mesh as the file will store it, and the original's samples.
/// Out:    no colours for models of one colour or none: base_colour alone. Swatches where they are asked for, see
///         swatches.h. Else a palette, see palette.h, in `colour` and `corner_uvs`. Without one, and where hues would be
///         lost in it: colours per vertex, on the grid, relative to base_colour, which is the largest value of each
///         channel; clients interpolate these in linear light, which makes a face between a light and a dark vertex a
///         little lighter.
///         Colours per vertex cannot cut out: what an original with alpha mask cuts out does not count, and is drawn in
///         the colours around; of one that blends the mean coverage remains, as one alpha for all.
///         Normals are fitted to those that the original is drawn with; none for unlit ones.
/// Cost:   that of VertexFit, twice with normals.
BakedModel paint(QuantizedMesh const& target, SurveyedModel const& original, SurfaceSamples const& samples,
                 PaintOptions const& options = {});

/// Gives the model normals per vertex, as the file stores them: fitted to those that the original is drawn with. With
/// `creases` vertices are parted at them.
void wear_normals(BakedModel& model, SurveyedModel const& original, SurfaceSamples const& samples,
                  PaintOptions const& options);

}  // namespace vitrine
