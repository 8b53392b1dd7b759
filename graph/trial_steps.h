// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the nodes of the graph do for one trial, by the job's study: stages and io, composed. Each throws what its
/// stage throws.

#include "graph/message.h"

#include <memory>

namespace vitrine::graph {

SimplifiedMesh shape_model(Job& job);
/// What needs no atlas: colours per vertex, the original's own texture, or neither.
BakedModel paint_model(SimplifiedMesh const& light, Job& job);
FlatCharts flatten_charts(ChartedMesh const& charts, Job& job);
Atlas pack_charts(std::shared_ptr<FlatCharts const> const& flat, Job& job);
BakedModel bake_maps(std::shared_ptr<Atlas const> const& atlas, Job& job);
EncodedThumbnail encode_thumbnail(std::shared_ptr<BakedModel const> const& baked, Job& job);
/// Decodes the file as a client does, draws it, and enters it into the study.
void weigh(std::shared_ptr<EncodedThumbnail const> const& file, Job& job);

/// As a client reads it, and not repaired: what a client cannot draw is to be seen.
SurveyedModel decode(EncodedThumbnail const& thumbnail, Occlusion occlusion);

}  // namespace vitrine::graph
