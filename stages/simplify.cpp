// SPDX-License-Identifier: Apache-2.0
#include "stages/simplify.h"

#include "stages/collapse_mesh.h"
#include "stages/quadric.h"
#include "stages/simplify_openmesh.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

namespace vitrine {
namespace {

using Index = CollapseMesh::Index;

/// An edge that may collapse; stale once an end has changed.
struct Candidate {
  Index a, b;
  Index version;  ///< of both ends together
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
  std::optional<std::pair<Candidate, std::size_t>> pop() {
    for (; lowest_ < buckets_.size(); ++lowest_) {
      std::vector<Candidate>& bucket = buckets_[lowest_];
      if (bucket.empty()) {
        std::vector<Candidate>().swap(bucket);
        continue;
      }
      Candidate const candidate = bucket.back();
      bucket.pop_back();
      return std::pair(candidate, lowest_);
    }
    return std::nullopt;
  }

 private:
  std::vector<std::vector<Candidate>> buckets_ = std::vector<std::vector<Candidate>>(std::size_t{1} << 15);
  std::size_t lowest_ = std::size_t{1} << 15;
};

/// What a collapse may do to the surface.
struct Rules {
  bool keep_topology;
  double least_cosine, least_roundness;  ///< see CollapseMesh::keeps_shape
};
constexpr Rules kStrict{true, 0.2, 0.02};
constexpr Rules kRelaxed{false, 0.01, 1e-5};

// Between 1e-7 and 1e-5 these constants change the mean distance on scans by 2 % at most; above, they cost detail.
constexpr double kStiffness = 1e-6;   // see Quadric::minimiser
constexpr double kLengthCost = 1e-5;  // short edges first where the surface is flat

class Collapser {
 public:
  Collapser(TriMesh const& mesh, double max_error)
      : mesh_(mesh),
        quadrics_(mesh_.vertices()),
        versions_(mesh_.vertices(), 0),
        max_distance_(max_error * mesh_.diagonal()) {
    for (Index f = 0; f < mesh_.faces(); ++f) add_face_plane(f);
    for (Index v = 0; v < mesh_.vertices(); ++v) add_edge_planes(v);
  }

  /// Collapses edges, cheapest first, until `target` faces are left or no edge may go.
  void run(std::size_t target, Rules const& rules) {
    for (Index v = 0; v < mesh_.vertices(); ++v)
      for (CollapseMesh::Neighbour const& n : mesh_.neighbours(v))
        if (n.vertex > v) push(v, n.vertex);
    while (mesh_.faces() > target) {
      auto const cheapest = queue_.pop();
      if (!cheapest) return;
      auto const& [candidate, bucket] = *cheapest;
      if (candidate.version == version(candidate.a, candidate.b)) try_collapse(candidate, bucket, rules);
    }
  }

  CollapseMesh const& mesh() const { return mesh_; }
  double error() const { return mesh_.diagonal() > 0 ? largest_distance_ / mesh_.diagonal() : 0; }
  bool limited() const { return limited_; }

 private:
  struct Placement {
    V3d at;
    double cost;      ///< decides the order
    double distance;  ///< to the planes: root of the mean square, weighted by area
  };

  void add_face_plane(Index f) {
    auto const& [a, b, c] = mesh_.face(f);
    V3d const p = mesh_.position(a), area = (mesh_.position(b) - p).cross(mesh_.position(c) - p);
    double const length = area.length();
    if (!(length > 0)) return;
    Quadric const plane = Quadric::plane(area / length, p, length / 2);
    for (Index v : {a, b, c}) quadrics_[v] += plane;
  }

  /// Planes through boundaries and non-manifold edges, perpendicular to the faces there: they hold the edges in place.
  void add_edge_planes(Index v) {
    for (CollapseMesh::Neighbour const& n : mesh_.neighbours(v)) {
      if (n.faces == 2 || n.vertex < v) continue;
      V3d const p = mesh_.position(v), edge = mesh_.position(n.vertex) - p;
      mesh_.for_faces(v, [&](Index f) {
        auto const& [a, b, c] = mesh_.face(f);
        if (a != n.vertex && b != n.vertex && c != n.vertex) return;
        V3d const normal = (mesh_.position(b) - mesh_.position(a)).cross(mesh_.position(c) - mesh_.position(a));
        V3d const across = edge.cross(normal);
        double const length = across.length();
        if (!(length > 0)) return;
        Quadric const plane = Quadric::plane(across / length, p, edge.length2());
        quadrics_[v] += plane;
        quadrics_[n.vertex] += plane;
      });
    }
  }

  Placement place(Index a, Index b) const {
    Quadric const quadric = quadrics_[a] + quadrics_[b];
    V3d const p = mesh_.position(a), q = mesh_.position(b), middle = (p + q) / 2;
    double const length2 = (q - p).length2();
    V3d at = quadric.minimiser(middle, kStiffness);
    if (!((at - middle).length2() <= length2))
      at = std::min({middle, p, q}, [&](V3d const& x, V3d const& y) { return quadric(x) < quadric(y); });
    double const sum = quadric(at), weight = quadric.weight();
    return {at, sum + kLengthCost * weight * length2, weight > 0 ? std::sqrt(sum / weight) : 0};
  }

  Index version(Index a, Index b) const { return versions_[a] + versions_[b]; }

  void push(Index a, Index b) { queue_.push(BucketQueue::bucket(place(a, b).cost), {a, b, version(a, b)}); }

  /// A refused candidate comes back when costs are 16 times as high: by then its surroundings may have changed.
  void postpone(Candidate const& candidate, std::size_t bucket) {
    bucket = std::max(bucket, BucketQueue::bucket(1e-18)) + 4 * BucketQueue::kOctave;
    if (bucket < BucketQueue::bucket(16)) queue_.push(bucket, candidate);
  }

  void try_collapse(Candidate const& candidate, std::size_t bucket, Rules const& rules) {
    auto const [a, b, stamp] = candidate;
    Placement const placement = place(a, b);
    if (placement.distance > max_distance_) {
      limited_ = true;
      return;
    }
    CollapseMesh::Junction const junction = mesh_.junction(a, b);
    if (junction.going == 0 || junction.going >= mesh_.faces()) return;
    if (rules.keep_topology && !junction.keeps_topology) return postpone(candidate, bucket);
    if (junction.vanishes) return try_vanish(candidate, bucket, placement);
    V3f const target = mesh_.to_model(placement.at);
    if (!mesh_.keeps_shape(a, b, target, rules.least_cosine, rules.least_roundness)) return postpone(candidate, bucket);
    mesh_.collapse(a, b, target);
    if (junction.closes) mesh_.remove_duplicates(a);
    largest_distance_ = std::max(largest_distance_, placement.distance);
    quadrics_[a] += quadrics_[b];
    ++versions_[a], ++versions_[b];
    for (CollapseMesh::Neighbour const& n : mesh_.neighbours(a)) push(a, n.vertex);
  }

  /// A part that vanishes is as wrong as if it had moved by its own size.
  void try_vanish(Candidate const& candidate, std::size_t bucket, Placement const& placement) {
    double const size = std::min(std::sqrt(mesh_.twice_area_around(candidate.a, candidate.b)), mesh_.diagonal());
    if (size > max_distance_) {
      limited_ = true;
      return;
    }
    std::size_t const dearer = BucketQueue::bucket(placement.cost + size * size * size * size);
    if (dearer > bucket) return queue_.push(dearer, candidate);
    largest_distance_ = std::max(largest_distance_, size);
    mesh_.remove_around(candidate.a);
    mesh_.remove_around(candidate.b);
  }

  CollapseMesh mesh_;
  std::vector<Quadric> quadrics_;
  std::vector<Index> versions_;
  BucketQueue queue_;
  double max_distance_;
  double largest_distance_ = 0;
  bool limited_ = false;
};

SimplifiedMesh simplify_optimal(TriMesh const& mesh, SimplifyOptions const& options) {
  std::size_t const target = static_cast<std::size_t>(options.triangles);
  Collapser collapser(mesh, options.max_error);
  CollapseMesh const& light = collapser.mesh();
  for (Rules const& rules : {kStrict, kRelaxed}) {
    std::size_t before = 0;
    do {  // what was refused may have become possible: again, while that takes away one face in a hundred
      before = light.faces();
      collapser.run(target, rules);
    } while (light.faces() > target && light.faces() < before - before / 100);
  }
  StopReason const stop = light.faces() <= target ? StopReason::target_reached
                          : collapser.limited()   ? StopReason::error_limit
                                                  : StopReason::nothing_left;
  return {light.extract(), static_cast<float>(collapser.error()), stop};
}

}  // namespace

SimplifiedMesh simplify(TriMesh const& mesh, SimplifyOptions const& options) {
  if (mesh.triangles.size() <= std::size_t(options.triangles))
    return {CollapseMesh(mesh).extract(), 0, StopReason::target_reached};
  return options.decimator == Decimator::optimal ? simplify_optimal(mesh, options) : simplify_openmesh(mesh, options);
}

}  // namespace vitrine
