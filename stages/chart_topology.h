// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Which faces meet, and which sets of faces are disks: shared by the stages that cut, merge and flatten charts.
/// Works on triangle lists with shared vertices; the mesh may be non-manifold, open and of many components.

#include "stages/data.h"

#include <span>

namespace vitrine {

inline constexpr std::uint32_t kNone = 0xffffffff;

struct FaceAdjacency {
  std::vector<Triangle> across;      ///< f: the face across the edge from corner i to corner i + 1, or kNone
  std::vector<std::uint32_t> first;  ///< n + 1: where in `faces` those around each vertex begin
  std::vector<std::uint32_t> faces;  ///< 3 f

  std::span<std::uint32_t const> around(std::uint32_t vertex) const {
    return std::span(faces).subspan(first[vertex], first[vertex + 1] - first[vertex]);
  }
};

/// Two faces are neighbours where they run through an edge in opposite directions. Where more than two meet at an edge,
/// pairs are formed, the flattest first: a non-manifold mesh falls into sheets, not into single faces.
FaceAdjacency face_adjacency(TriMesh const& mesh);

/// Why these faces, taken alone, are no disk; empty if they are: connected over edges that two of them run through in
/// opposite directions, no edge used otherwise, no pinched vertex, Euler characteristic 1 (hence one boundary loop).
std::string disk_defect(std::span<Triangle const> triangles);

/// Whether `chart`, a disk, stays one when `face`, which is not in it, joins.
bool keeps_disk(TriMesh const& mesh, FaceAdjacency const& adjacency, std::span<std::uint32_t const> face_charts,
                std::uint32_t face, std::uint32_t chart);

/// Grows disks from the seeds over all faces, those of the highest priority first (ties: the lowest index). A face that
/// would turn each neighbouring chart into something else than a disk starts a chart of its own. Returns the number of
/// charts; face_charts gets f of them.
std::uint32_t grow_disks(TriMesh const& mesh, FaceAdjacency const& adjacency, std::span<std::uint32_t const> seeds,
                         std::span<double const> priority, std::vector<std::uint32_t>& face_charts);

/// Cuts a disk of at least two faces into disks, at least two, grown from two faces far apart; the faces of each.
std::vector<std::vector<std::uint32_t>> cut_disk(TriMesh const& disk);

/// Faces of each chart, in ascending order.
std::vector<std::vector<std::uint32_t>> faces_of_charts(std::span<std::uint32_t const> face_charts,
                                                        std::uint32_t charts);

/// The given faces as a mesh of their own; vertices in ascending order.
TriMesh submesh(TriMesh const& mesh, std::span<std::uint32_t const> faces);

}  // namespace vitrine
