// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the nodes of the graph do to one model: stages and io, composed; what comes of it noted in the model's row.
/// Each throws what its stage throws.

#include "graph/message.h"
#include "graph/options.h"
#include "stages/clean.h"
#include "stages/measure.h"

#include <filesystem>
#include <optional>

namespace vitrine::graph {

/// A model as every trial needs it: made once.
struct Original {
  SurveyedModel model;
  Reference reference;  ///< without pictures where nothing is measured
};

/// The light mesh in some state, and the original it stands for.
template <class T>
struct Against {
  std::shared_ptr<Original const> original;
  T light;
};

/// A file, and what a client shows of it.
struct Finished {
  EncodedThumbnail thumbnail;
  Image poster;
};

template <class T>
using In = std::shared_ptr<T const>;

CleanModel load_model(Job& job, io::ReadOptions const& options);
Original survey_model(In<CleanModel> const& clean, PublishOptions const& options);
Against<SimplifiedMesh> simplify_model(In<Original> const& original, SimplifyOptions const& options, Job& job);
Against<Atlas> pack_charts(In<Against<FlatCharts>> const& flat, PackOptions const& options, Job& job);
Against<BakedModel> bake_maps(In<Against<Atlas>> const& packed, ModelOptions const& options, Job& job);
Against<EncodedThumbnail> encode_thumbnail(In<Against<BakedModel>> const& baked, io::EncodeOptions const& options, Job& job);

/// Decodes the file as a client does, draws it, and compares it with its original.
Finished measure_thumbnail(In<Against<EncodedThumbnail>> const& encoded, Job& job);

/// Writes the model's folder: the data first, the certificate last, so that a certificate vouches for what is there.
void publish_model(Finished const& finished, ModelOptions const& options, std::filesystem::path const& gallery, Job& job);

}  // namespace vitrine::graph
