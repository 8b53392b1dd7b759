// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the readers do alike with what they found. Internal to io.

#include "io/read_model.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace vitrine::io {

inline constexpr Rgba16 kWhite{65535, 65535, 65535, 65535};

/// What a vertex with all attributes may take, before and after splitting.
inline constexpr std::uint64_t kBytesPerVertex = sizeof(V3d) + 2 * sizeof(V3f) + sizeof(V2f) + sizeof(Rgba16) + 28;

/// What the model's arrays take.
std::uint64_t bytes_of(SourceModel const& model);

/// The direction of `v`; zero when it has none or is not finite, which `clean` repairs.
V3f unit_or_zero(V3d const& v);

/// The error of a file that holds points alone.
Error no_faces(std::string const& format, std::uint64_t vertices);

/// Errors: LimitExceeded when a mesh of these counts, whose arrays take `bytes`, exceeds the limits (or 32-bit
/// indices).
void check_limits(ReadLimits const& limits, std::uint64_t vertices, std::uint64_t triangles, std::uint64_t bytes);

/// Sets the positions. Where the model is small and far from zero, so that floats would lose its detail, it is moved to
/// the middle of its bounding box and `origin` says so. Coordinates that are not finite stay so.
void place(SourceModel& model, std::span<V3d const> positions);

/// Attributes of corners, which a SourceModel has not: each empty or one per triangle.
struct CornerAttributes {
  std::vector<CornerUvs> uvs;
  std::vector<Rgba16> face_colours;
};

/// Splits vertices until each has one texture coordinate and one colour, in the order of first use by a corner.
/// Vertices that no triangle uses are dropped.
void split_vertices(SourceModel& model, CornerAttributes const& attributes);

}  // namespace vitrine::io
