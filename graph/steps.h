// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the nodes of the graph do to one model: stages and io, composed; what comes of it noted in the model's row.
/// Each throws what its stage throws.

#include "graph/message.h"
#include "graph/options.h"
#include "graph/series_files.h"
#include "stages/clean.h"

#include <filesystem>

namespace vitrine::graph {

/// A file, and what a client shows of it.
struct Finished {
  EncodedThumbnail thumbnail;
  Image poster;
  std::optional<SeriesFiles> series;
};

CleanModel load_model(Job& job, ModelOptions const& options);
Original survey_model(std::shared_ptr<CleanModel const> const& clean, ModelOptions const& options);
Levels simplify_model(Original const& original, ModelOptions const& options);
Subject subject_of(Original const& original, Levels const& levels, ModelOptions const& options);

// ---- One trial: by the job's study

SimplifiedMesh shape_model(Job& job);
/// What needs no atlas: colours per vertex, the original's own texture, or neither.
BakedModel paint_model(SimplifiedMesh const& light, Job& job);
FlatCharts flatten_charts(ChartedMesh const& charts, Job& job);
Atlas pack_charts(std::shared_ptr<FlatCharts const> const& flat, Job& job);
BakedModel bake_maps(std::shared_ptr<Atlas const> const& atlas, Job& job);
EncodedThumbnail encode_thumbnail(std::shared_ptr<BakedModel const> const& baked, Job& job);
/// Decodes the file as a client does, draws it, and enters it into the study.
void weigh(std::shared_ptr<EncodedThumbnail const> const& file, Job& job);

// ---- The winner

Finished certify(EncodedThumbnail const& thumbnail, PublishOptions const& options, Job& job);
/// Writes the model's folder: the data first, the certificate last, so that a certificate vouches for what is there.
void publish_model(Finished const& finished, ModelOptions const& options, std::filesystem::path const& gallery, Job& job);

}  // namespace vitrine::graph
