// SPDX-License-Identifier: Apache-2.0
#include "stages/collapser.h"

#include <algorithm>
#include <cmath>

namespace vitrine {

std::optional<std::pair<Candidate, std::size_t>> BucketQueue::pop() {
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

/// What a collapse may do to the surface.
template <class Q>
struct Collapser<Q>::Rules {
  bool keep_topology;
  double least_cosine, least_roundness;  ///< see CollapseMesh::keeps_shape

  static constexpr Rules strict() { return {true, 0.2, 0.02}; }
  static constexpr Rules relaxed() { return {false, 0.01, 1e-5}; }
};

namespace {

// Between 1e-7 and 1e-5 these constants change the mean distance on scans by 2 % at most; above, they cost detail.
constexpr double kStiffness = 1e-6;   // see Quadric::minimiser
constexpr double kLengthCost = 1e-5;  // short edges first where the surface is flat

/// A part that vanishes, or a handle that closes, is as wrong as if it had moved by its own size.
constexpr double cost_of_part(double size) { return size * size * size * size; }

}  // namespace

template <class Q>
Collapser<Q>::Collapser(TriMesh const& mesh, double max_error, VertexColours const& colours)
    : mesh_(mesh),
      quadrics_(mesh_.vertices()),
      versions_(mesh_.vertices(), 0),
      max_distance_(max_error * mesh_.diagonal()) {
  for (Index f = 0; f < mesh_.faces(); ++f) {
    add_face_plane(f);
    if constexpr (std::same_as<Q, ColourQuadric>) add_face_colours(f, colours);
  }
  for (Index v = 0; v < mesh_.vertices(); ++v) add_edge_planes(v);
  push_all();
}

template <class Q>
void Collapser<Q>::reduce_to(std::size_t target) {
  while (mesh_.faces() > target && !done_) {
    auto const cheapest = queue_.pop();
    if (!cheapest) {
      done_ = !next_pass();
      continue;
    }
    auto const& [candidate, bucket] = *cheapest;
    if (candidate.version == version(candidate.a, candidate.b)) try_collapse(candidate, bucket);
  }
}

template <class Q>
void Collapser<Q>::record(std::vector<CollapseStep>* steps, std::vector<std::pair<Index, Index>>* went) {
  steps_ = steps;
  went_ = went;
  mesh_.note_removed(&removed_);
}

template <class Q>
StopReason Collapser<Q>::stop(std::size_t target) const {
  if (mesh_.faces() <= target) return StopReason::target_reached;
  return limited_ ? StopReason::error_limit : StopReason::nothing_left;
}

template <class Q>
void Collapser<Q>::push_all() {
  faces_before_ = mesh_.faces();
  for (Index v = 0; v < mesh_.vertices(); ++v)
    for (CollapseMesh::Neighbour const& n : mesh_.neighbours(v))
      if (n.vertex > v) push(v, n.vertex);
}

/// What was refused may have become possible: again, while that takes away one face in a hundred; then once more by
/// looser rules.
template <class Q>
bool Collapser<Q>::next_pass() {
  bool const fruitful = mesh_.faces() < faces_before_ - faces_before_ / 100;
  if (!fruitful && relaxed_) return false;
  relaxed_ = relaxed_ || !fruitful;
  push_all();
  return true;
}

template <class Q>
void Collapser<Q>::add_face_plane(Index f) {
  auto const& [a, b, c] = mesh_.face(f);
  V3d const p = mesh_.position(a), area = (mesh_.position(b) - p).cross(mesh_.position(c) - p);
  double const length = area.length();
  if (!(length > 0)) return;
  Q const plane = Q::plane(area / length, p, length / 2);
  for (Index v : {a, b, c}) quadrics_[v] += plane;
}

template <class Q>
void Collapser<Q>::add_face_colours(Index f, VertexColours const& colours) {
  std::array<V3d, 3> places, values;
  for (int k = 0; k < 3; ++k) {
    places[k] = mesh_.position(mesh_.face(f)[k]);
    values[k] = V3d(colours.values[mesh_.face(f)[k]]) * (colours.weight * mesh_.diagonal() / 2);
  }
  double const area = (places[1] - places[0]).cross(places[2] - places[0]).length() / 2;
  for (Index v : mesh_.face(f))
    if constexpr (std::same_as<Q, ColourQuadric>) quadrics_[v].add_colours(places, values, area);
}

/// Planes through boundaries and non-manifold edges, perpendicular to the faces there: they hold the edges in place.
template <class Q>
void Collapser<Q>::add_edge_planes(Index v) {
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
      Q const plane = Q::plane(across / length, p, edge.length2());
      quadrics_[v] += plane;
      quadrics_[n.vertex] += plane;
    });
  }
}

template <class Q>
typename Collapser<Q>::Placement Collapser<Q>::place(Index a, Index b) const {
  Q const sum = quadrics_[a] + quadrics_[b];
  Quadric const quadric = sum.of_place();
  V3d const p = mesh_.position(a), q = mesh_.position(b), middle = (p + q) / 2;
  double const length2 = (q - p).length2();
  double const weight = sum.weight();
  V3d at = quadric.minimiser(middle, kStiffness * weight);
  if (!((at - middle).length2() <= length2))
    at = std::min({middle, p, q}, [&](V3d const& x, V3d const& y) { return quadric(x) < quadric(y); });
  double const error = quadric(at);
  return {at, error + kLengthCost * weight * length2, weight > 0 ? std::sqrt(error / weight) : 0};
}

/// A refused candidate comes back when costs are 16 times as high: by then its surroundings may have changed.
template <class Q>
void Collapser<Q>::postpone(Candidate const& candidate, std::size_t bucket) {
  bucket = std::max(bucket, BucketQueue::bucket(1e-18)) + 4 * BucketQueue::kOctave;
  if (bucket < BucketQueue::bucket(16)) queue_.push(bucket, candidate);
}

template <class Q>
void Collapser<Q>::try_collapse(Candidate const& candidate, std::size_t bucket) {
  auto const [a, b, stamp] = candidate;
  Placement const placement = place(a, b);
  Rules const rules = relaxed_ ? Rules::relaxed() : Rules::strict();
  if (placement.distance > max_distance_) {
    limited_ = true;
    return;
  }
  CollapseMesh::Junction const junction = mesh_.junction(a, b);
  if (junction.going == 0 || junction.going >= mesh_.faces()) return;
  if (rules.keep_topology && !junction.keeps_topology &&
      bucket < BucketQueue::bucket(placement.cost + cost_of_part(size_around(a, b))))
    return postpone(candidate, bucket);
  if (junction.vanishes) return try_vanish(candidate, bucket, placement);
  V3f const target = mesh_.to_model(placement.at);
  if (!mesh_.keeps_shape(a, b, target, rules.least_cosine, rules.least_roundness)) return postpone(candidate, bucket);
  mesh_.collapse(a, b, target);
  if (junction.closes) mesh_.remove_duplicates(a);
  largest_distance_ = std::max(largest_distance_, placement.distance);
  quadrics_[a] += quadrics_[b];
  ++versions_[a], ++versions_[b];
  note(a, b, target);
  for (CollapseMesh::Neighbour const& n : mesh_.neighbours(a)) push(a, n.vertex);
}

template <class Q>
double Collapser<Q>::size_around(Index a, Index b) {
  return std::min(std::sqrt(mesh_.twice_area_around(a, b)), mesh_.diagonal());
}

template <class Q>
void Collapser<Q>::try_vanish(Candidate const& candidate, std::size_t bucket, Placement const& placement) {
  double const size = size_around(candidate.a, candidate.b);
  if (size > max_distance_) {
    limited_ = true;
    return;
  }
  std::size_t const dearer = BucketQueue::bucket(placement.cost + cost_of_part(size));
  if (dearer > bucket) return queue_.push(dearer, candidate);
  largest_distance_ = std::max(largest_distance_, size);
  mesh_.remove_around(candidate.a);
  mesh_.remove_around(candidate.b);
  note(candidate.a, candidate.a, V3f(0));
}

template <class Q>
void Collapser<Q>::note(Index into, Index from, V3f const& place) {
  if (!steps_) return;
  for (Index f : removed_) went_->emplace_back(f, Index(steps_->size()));
  removed_.clear();
  steps_->push_back({into, from, place, error(), Index(mesh_.faces())});
}

template class Collapser<Quadric>;
template class Collapser<ColourQuadric>;

}  // namespace vitrine
