// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The order in which the edges of a mesh collapse, cheapest first, and where each collapse puts its vertex.
/// The order does not depend on how far it goes: a mesh of fewer faces is always made from the one of more.

#include "stages/collapse_mesh.h"
#include "stages/colour_quadric.h"
#include "stages/simplify.h"

#include <bit>
#include <concepts>
#include <optional>
#include <utility>
#include <vector>

namespace vitrine {

/// An edge that may collapse; stale once an end has changed.
struct Candidate {
  CollapseMesh::Index a, b;
  CollapseMesh::Index version;  ///< of both ends together
};

/// Candidates by cost, in buckets: exact to one part in 128, and of equal ones the last comes first. Order within a
/// bucket buys nothing, while a binary heap of millions of candidates takes longer than all the rest.
class BucketQueue {
 public:
  static constexpr std::size_t kOctave = 128;  ///< buckets in which costs double
  static std::size_t bucket(double cost) { return std::bit_cast<std::uint32_t>(static_cast<float>(cost)) >> 16; }

  void push(std::size_t bucket, Candidate const& candidate) {
    buckets_[bucket].push_back(candidate);
    lowest_ = std::min(lowest_, bucket);
  }

  /// The cheapest candidate and its bucket.
  std::optional<std::pair<Candidate, std::size_t>> pop();

 private:
  std::vector<std::vector<Candidate>> buckets_ = std::vector<std::vector<Candidate>>(std::size_t{1} << 15);
  std::size_t lowest_ = std::size_t{1} << 15;
};

/// One change of the mesh: an edge collapsed into one of its ends, or a part that vanished.
struct CollapseStep {
  CollapseMesh::Index into, from;  ///< equal where a part vanished
  V3f place;                       ///< of `into` from now on
  float error;                     ///< so far, as a share of the bounding box's diagonal
  std::uint32_t faces;             ///< that are left
};

/// With Quadric or ColourQuadric: the latter costs twice the memory and time.
template <class Q>
class Collapser {
 public:
  using Index = CollapseMesh::Index;

  /// `max_error` is a share of the bounding box's diagonal. Quadric does not read the colours.
  Collapser(TriMesh const& mesh, double max_error, VertexColours const& colours);

  /// Goes on until `target` faces are left or no edge may go.
  void reduce_to(std::size_t target);

  /// From now on each step is noted in `steps`, and each face that goes, with the step's number, in `went`.
  void record(std::vector<CollapseStep>* steps, std::vector<std::pair<Index, Index>>* went);

  CollapseMesh const& mesh() const { return mesh_; }
  float error() const { return float(mesh_.diagonal() > 0 ? largest_distance_ / mesh_.diagonal() : 0); }
  StopReason stop(std::size_t target) const;

 private:
  struct Rules;
  struct Placement {
    V3d at;
    double cost;      ///< decides the order
    double distance;  ///< to the planes: root of the mean square, weighted by area
  };

  void add_face_plane(Index f);
  void add_face_colours(Index f, VertexColours const& colours);
  void add_edge_planes(Index v);
  void push_all();
  bool next_pass();
  Placement place(Index a, Index b) const;
  Index version(Index a, Index b) const { return versions_[a] + versions_[b]; }
  void push(Index a, Index b) { queue_.push(BucketQueue::bucket(place(a, b).cost), {a, b, version(a, b)}); }
  void postpone(Candidate const& candidate, std::size_t bucket);
  void try_collapse(Candidate const& candidate, std::size_t bucket);
  double size_around(Index a, Index b);  ///< the root of twice the area
  void try_vanish(Candidate const& candidate, std::size_t bucket, Placement const& placement);
  void note(Index into, Index from, V3f const& place);

  CollapseMesh mesh_;
  std::vector<Q> quadrics_;
  std::vector<Index> versions_;
  BucketQueue queue_;
  std::vector<CollapseStep>* steps_ = nullptr;
  std::vector<std::pair<Index, Index>>* went_ = nullptr;
  std::vector<Index> removed_;  ///< by the current step
  double max_distance_;
  double largest_distance_ = 0;
  std::size_t faces_before_ = 0;  ///< when the current pass began
  bool relaxed_ = false, done_ = false, limited_ = false;
};

extern template class Collapser<Quadric>;
extern template class Collapser<ColourQuadric>;

}  // namespace vitrine
