// SPDX-License-Identifier: Apache-2.0
#include "graph/arrival.h"

#include <algorithm>

namespace vitrine::graph {
std::string title_of(io::ArchiveEntry const& entry) {
  auto const title = entry.metadata.find("title");
  bool const titled = title != entry.metadata.end() && !title->second.empty();
  return titled ? title->second : std::filesystem::path(entry.path).stem().string();
}

std::uint64_t memory_of(io::ArchiveEntry const& entry, ClusterOptions const& clusters) {
  io::Estimate const& estimate = entry.estimate;
  bool const thinned = estimate.thinned > 0 && estimate.triangles > std::uint64_t(clusters.above);
  return thinned ? std::min(estimate.thinned, estimate.memory) : estimate.memory;
}

ModelRow arriving(io::ArchiveEntry const& entry, ClusterOptions const& clusters) {
  ModelRow row;
  row.slug = entry.slug;
  row.title = title_of(entry);
  row.input_bytes = entry.bytes;
  refresh(row, entry, clusters);
  return row;
}

void refresh(ModelRow& row, io::ArchiveEntry const& entry, ClusterOptions const& clusters) {
  row.input = entry.path;
  row.metadata = entry.metadata;
  row.memory = memory_of(entry, clusters);
}

}  // namespace vitrine::graph
