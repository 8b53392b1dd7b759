// SPDX-License-Identifier: Apache-2.0
#include "stages/relax.h"

#include "stages/planar_face.h"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>

namespace vitrine {
namespace {

constexpr int kRounds = 10;

/// Half the Dirichlet energy of a face is the sum over its edges of this times the squared difference along the edge:
/// the cotangent of the angle opposite to the edge from corner i to the next.
std::array<double, 3> edge_weights(PlanarFace const& face) {
  std::array<double, 3> weights;
  for (std::size_t i = 0; i < 3; ++i) {
    Complex const apex = face.corners[(i + 2) % 3], a = face.corners[i] - apex, b = face.corners[(i + 1) % 3] - apex;
    weights[i] = (a.real() * b.real() + a.imag() * b.imag()) / cross(a, b);
  }
  return weights;
}

class Relaxation {
 public:
  Relaxation(TriMesh const& disk, std::vector<PlanarFace> faces) : disk_(disk), faces_(std::move(faces)) {
    for (PlanarFace const& face : faces_) weights_.push_back(edge_weights(face));
  }

  /// The first vertex stays where it is.
  bool factorise() {
    std::vector<Eigen::Triplet<double>> entries;
    auto const add = [&](std::uint32_t row, std::uint32_t column, double value) {
      if (row > 0 && column > 0 && column <= row) entries.emplace_back(int(row) - 1, int(column) - 1, value);
    };
    for (std::size_t f = 0; f < faces_.size(); ++f)
      for (std::size_t i = 0; i < 3; ++i) {
        std::uint32_t const a = disk_.triangles[f][i], b = disk_.triangles[f][(i + 1) % 3];
        add(a, a, weights_[f][i]);
        add(b, b, weights_[f][i]);
        add(std::max(a, b), std::min(a, b), -weights_[f][i]);
      }
    int const unknowns = int(disk_.positions.size()) - 1;
    Eigen::SparseMatrix<double> laplacian(unknowns, unknowns);
    laplacian.setFromTriplets(entries.begin(), entries.end());
    solver_.compute(laplacian);
    return solver_.info() == Eigen::Success;
  }

  /// Turns each face to fit the map, then finds the map that fits the turned faces.
  bool round(std::vector<Complex>& map) const {
    Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(Eigen::Index(map.size()) - 1, 2);
    auto const add = [&](std::uint32_t vertex, Complex value) {
      if (vertex > 0) right.row(vertex - 1) += Eigen::RowVector2d(value.real(), value.imag());
    };
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      Complex const turn = rotation(f, map);
      for (std::size_t i = 0; i < 3; ++i) {
        std::uint32_t const a = disk_.triangles[f][i], b = disk_.triangles[f][(i + 1) % 3];
        Complex const pull = weights_[f][i] * turn * (faces_[f].corners[i] - faces_[f].corners[(i + 1) % 3]);
        add(a, pull);
        add(b, -pull);
      }
    }
    // Of the system for places relative to the first vertex, which then lies at zero.
    Eigen::MatrixX2d const solution = solver_.solve(right);
    if (!solution.allFinite()) return false;
    map[0] = 0;
    for (std::size_t v = 1; v < map.size(); ++v)
      map[v] = {solution(Eigen::Index(v) - 1, 0), solution(Eigen::Index(v) - 1, 1)};
    return true;
  }

  /// After which the map has the area that its faces are to have.
  double scale_to_area(std::vector<Complex> const& map) const {
    double wanted = 0, area = 0;
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      Triangle const& t = disk_.triangles[f];
      wanted += faces_[f].area();
      area += cross(map[t[1]] - map[t[0]], map[t[2]] - map[t[0]]) / 2;
    }
    return area > 0 ? std::sqrt(wanted / area) : 1;
  }

 private:
  Complex rotation(std::size_t f, std::vector<Complex> const& map) const {
    Complex sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      std::uint32_t const a = disk_.triangles[f][i], b = disk_.triangles[f][(i + 1) % 3];
      sum += weights_[f][i] * (map[a] - map[b]) * std::conj(faces_[f].corners[i] - faces_[f].corners[(i + 1) % 3]);
    }
    double const length = std::abs(sum);
    return length > 0 ? sum / length : Complex(1);
  }

  TriMesh const& disk_;
  std::vector<PlanarFace> faces_;
  std::vector<std::array<double, 3>> weights_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> solver_;
};

}  // namespace

std::vector<V2f> relax(TriMesh const& disk, std::vector<V2f> const& uvs, std::vector<float> const& lengths) {
  Box3f const box = bounds(disk);
  std::vector<PlanarFace> faces = lay_faces_flat(disk, V3d(box.max - box.min).length());
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (Complex& corner : faces[f].corners) corner *= lengths[f];
  Relaxation relaxation(disk, std::move(faces));
  if (!relaxation.factorise()) return {};
  std::vector<Complex> map;
  for (V2f const& uv : uvs) map.push_back(plane(uv));
  for (int i = 0; i < kRounds; ++i)
    if (!relaxation.round(map)) return {};
  double const scale = relaxation.scale_to_area(map);
  std::vector<V2f> out;
  for (Complex z : map) out.emplace_back(float(scale * z.real()), float(-scale * z.imag()));
  return out;
}

}  // namespace vitrine
