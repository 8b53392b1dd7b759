// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the nodes of the graph do to one model before and after its trials (trial_steps.h): stages and io, composed;
/// what comes of it noted in the model's row. Each throws what its stage throws.

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
Original survey_model(std::shared_ptr<CleanModel const> const& clean, ModelOptions const& options, Job& job);
Levels simplify_model(Original const& original, ModelOptions const& options);
Subject subject_of(Original const& original, Levels const& levels, ModelOptions const& options);

Finished certify(EncodedThumbnail const& thumbnail, PublishOptions const& options, Job& job);
/// Writes the model's folder: the data first, the certificate last, so that a certificate vouches for what is there.
void publish_model(Finished const& finished, ModelOptions const& options, std::filesystem::path const& gallery,
                   Job& job);

}  // namespace vitrine::graph
