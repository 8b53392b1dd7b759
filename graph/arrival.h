// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What is known of a model before it is opened.

#include "graph/report.h"
#include "stages/cluster.h"

namespace vitrine::graph {

/// From archive.csv, else the file's name.
std::string title_of(io::ArchiveEntry const& entry);

/// Bytes that it is admitted with.
std::uint64_t memory_of(io::ArchiveEntry const& entry, ClusterOptions const& clusters);

ModelRow arriving(io::ArchiveEntry const& entry, ClusterOptions const& clusters);

/// Gives a row of an earlier run what the archive says of the model today and no thumbnail depends on.
void refresh(ModelRow& row, io::ArchiveEntry const& entry, ClusterOptions const& clusters);

}  // namespace vitrine::graph
