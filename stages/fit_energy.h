// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How badly a light mesh stands for its original, as a quadratic function of where its vertices go.

#include "stages/edges.h"
#include "stages/surface_samples.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace vitrine {

class FaceGrid;

/// A symmetric 3 x 3 matrix.
struct Symmetric {
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;

  static Symmetric outer(V3d const& n) { return {n.x * n.x, n.x * n.y, n.x * n.z, n.y * n.y, n.y * n.z, n.z * n.z}; }
  void add(Symmetric const& m, double times) {
    xx += times * m.xx, xy += times * m.xy, xz += times * m.xz;
    yy += times * m.yy, yz += times * m.yz, zz += times * m.zz;
  }
  V3d operator*(V3d const& v) const {
    return {xx * v.x + xy * v.y + xz * v.z, xy * v.x + yy * v.y + yz * v.z, xz * v.x + yz * v.y + zz * v.z};
  }
  /// The x with *this x = v, for a positive definite matrix.
  V3d solve(V3d const& v) const;
};

/// Each sample counts with the squared distance, along its normal, to the place of the mesh that it was closest to, and
/// with a thousandth of the whole squared distance. Ridges and outlines, which are what is seen against the background,
/// count ten times: a sample there with its distance across its line, to the surface and to the mesh's outline; without
/// that, blades grow blunt and ragged outlines shrink. Each face counts with the squared slopes of its edges against
/// the mean shading normal of its samples, as it will be drawn flat: a radian as much as if all its samples were off by
/// a quarter of the root of its area, times `facet_weight`. Each vertex has a very small pull to its place, a strong
/// one where more than two faces meet. Moves are in units of the samples' radius. The mesh must outlive this.
/// Cost:   the constructor about 0.25 microseconds a sample and 2 a face; samples are matched in parallel.
class FitEnergy {
 public:
  FitEnergy(TriMesh const& mesh, SurfaceSamples const& samples, double facet_weight);

  double scale() const { return scale_; }  ///< length of a move of 1, in the mesh's unit

  /// Energy of moves from the mesh's places, less that of staying.
  double operator()(std::vector<V3d> const& moves) const;

  /// The moves of least energy, by conjugate gradients.
  std::vector<V3d> least() const;

  /// The energy of one vertex's further move m, all others staying where `moves` has taken them: m'Am - 2b'm.
  struct Local {
    Symmetric a;
    V3d b{0, 0, 0};
    double operator()(V3d const& move) const { return (a * move - b * 2.0).dot(move); }
  };
  Local around(std::uint32_t vertex, std::vector<V3d> const& moves) const;

  std::span<std::uint32_t const> faces_of(std::uint32_t vertex) const {
    return {vertex_faces_.data() + first_face_[vertex], first_face_[vertex + 1] - first_face_[vertex]};
  }

 private:
  /// Of one face: the sum over corners i, j of m_i' h_ij m_j, less twice that of g_i' m_i.
  struct Form {
    std::array<Symmetric, 6> h;  ///< 00, 11, 22, 01, 12, 20
    std::array<V3d, 3> g{V3d(0), V3d(0), V3d(0)};

    /// Adds gap'(metric)gap, where the gap closes by the moves of the corners, by these shares.
    void add(std::array<double, 3> const& share, Symmetric const& metric, V3d const& gap);
  };

  void list_faces();
  void add_samples(SurfaceSamples const& samples, FaceGrid const& grid);
  void add_ridges(SurfaceSamples const& samples, FaceGrid const& grid);
  void add_outline(SurfaceSamples const& samples);
  void add_facets(double facet_weight);
  void add_pulls();
  std::vector<V3d> times(std::vector<V3d> const& moves) const;  ///< the matrix of all forms

  TriMesh const& mesh_;
  double scale_;
  std::vector<Form> forms_;
  std::vector<V3d> sums_of_normals_;   ///< per face, of its samples
  std::vector<std::uint32_t> counts_;  ///< per face, its samples
  std::vector<Symmetric> pulls_;       ///< per vertex
  Outline outline_;
  std::vector<std::uint32_t> first_face_, vertex_faces_;
};

}  // namespace vitrine
