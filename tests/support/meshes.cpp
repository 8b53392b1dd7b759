// SPDX-License-Identifier: Apache-2.0
#include "tests/support/meshes.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace vitrine::test {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

std::uint32_t index(int i) { return static_cast<std::uint32_t>(i); }

/// Splits the quad (a b c d), counter-clockwise, into two faces.
void quad(TriMesh& mesh, int a, int b, int c, int d) {
  mesh.triangles.push_back({index(a), index(b), index(c)});
  mesh.triangles.push_back({index(a), index(c), index(d)});
}

}  // namespace

TriMesh triangle() { return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}; }

TriMesh tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

TriMesh cube(V3f centre, float edge) {
  TriMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.positions.push_back(centre + V3f(float(i & 1) - 0.5f, float(i >> 1 & 1) - 0.5f, float(i >> 2) - 0.5f) * edge);
  quad(mesh, 0, 2, 3, 1);
  quad(mesh, 4, 5, 7, 6);
  quad(mesh, 0, 1, 5, 4);
  quad(mesh, 2, 6, 7, 3);
  quad(mesh, 0, 4, 6, 2);
  quad(mesh, 1, 3, 7, 5);
  return mesh;
}

TriMesh open_cone(int sides) {
  TriMesh mesh;
  mesh.positions.push_back({0, 1, 0});
  for (int i = 0; i < sides; ++i) {
    float const a = 2 * kPi * float(i) / float(sides);
    mesh.positions.push_back({std::cos(a), 0, -std::sin(a)});
    mesh.triangles.push_back({0, index(1 + i), index(1 + (i + 1) % sides)});
  }
  return mesh;
}

TriMesh grid(int columns, int rows) {
  TriMesh mesh;
  for (int r = 0; r <= rows; ++r)
    for (int c = 0; c <= columns; ++c) mesh.positions.push_back({float(c), 0, float(r)});
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      int const a = r * (columns + 1) + c, b = a + columns + 1;
      quad(mesh, a, b, b + 1, a + 1);
    }
  return mesh;
}

TriMesh bumpy_sphere(int slices, int stacks, unsigned seed) {
  TriMesh mesh = sphere(slices, stacks);
  float const s = float(seed);
  for (V3f& p : mesh.positions)
    p *= 1 + 0.08f * std::sin(5 * p.x + s) * std::cos(4 * p.y + 2 * s) + 0.03f * std::sin(11 * p.z + 3 * s);
  return mesh;
}

TriMesh sphere(int slices, int stacks) {
  TriMesh mesh;
  mesh.positions.push_back({0, 1, 0});
  for (int t = 1; t < stacks; ++t)
    for (int s = 0; s < slices; ++s) {
      float const theta = kPi * float(t) / float(stacks), phi = 2 * kPi * float(s) / float(slices);
      mesh.positions.push_back({std::sin(theta) * std::cos(phi), std::cos(theta), -std::sin(theta) * std::sin(phi)});
    }
  mesh.positions.push_back({0, -1, 0});
  int const last = int(mesh.positions.size()) - 1;
  auto at = [&](int t, int s) { return 1 + (t - 1) * slices + s % slices; };
  for (int s = 0; s < slices; ++s) mesh.triangles.push_back({0, index(at(1, s)), index(at(1, s + 1))});
  for (int t = 1; t + 1 < stacks; ++t)
    for (int s = 0; s < slices; ++s) quad(mesh, at(t, s), at(t + 1, s), at(t + 1, s + 1), at(t, s + 1));
  for (int s = 0; s < slices; ++s)
    mesh.triangles.push_back({index(last), index(at(stacks - 1, s + 1)), index(at(stacks - 1, s))});
  return mesh;
}

TriMesh torus(int major, int minor, float radius, float tube) {
  TriMesh mesh;
  for (int i = 0; i < major; ++i)
    for (int j = 0; j < minor; ++j) {
      float const u = 2 * kPi * float(i) / float(major), v = 2 * kPi * float(j) / float(minor);
      float const r = radius + tube * std::cos(v);
      mesh.positions.push_back({r * std::cos(u), tube * std::sin(v), -r * std::sin(u)});
    }
  auto at = [&](int i, int j) { return i % major * minor + j % minor; };
  for (int i = 0; i < major; ++i)
    for (int j = 0; j < minor; ++j) quad(mesh, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
  return mesh;
}

TriMesh pierced_slab(int holes) {
  TriMesh mesh;
  int const cells = 2 * holes + 1, layer = (cells + 1) * (cells + 1);
  for (float y : {1.0f, 0.0f})
    for (int r = 0; r <= cells; ++r)
      for (int c = 0; c <= cells; ++c) mesh.positions.push_back({float(c), y, float(r)});
  auto solid = [&](int c, int r) { return c >= 0 && r >= 0 && c < cells && r < cells && (c % 2 == 0 || r % 2 == 0); };
  auto wall = [&](int p, int q) { quad(mesh, q, p, p + layer, q + layer); };  // hangs from the edge p-q of the top
  for (int r = 0; r < cells; ++r)
    for (int c = 0; c < cells; ++c) {
      if (!solid(c, r)) continue;
      int const a = r * (cells + 1) + c, b = a + cells + 1;
      quad(mesh, a, b, b + 1, a + 1);
      quad(mesh, a + layer, a + 1 + layer, b + 1 + layer, b + layer);
      if (!solid(c - 1, r)) wall(a, b);
      if (!solid(c, r + 1)) wall(b, b + 1);
      if (!solid(c + 1, r)) wall(b + 1, a + 1);
      if (!solid(c, r - 1)) wall(a + 1, a);
    }
  return mesh;
}

TriMesh moebius(int steps) {
  TriMesh mesh;
  for (int i = 0; i < steps; ++i) {
    float const a = 2 * kPi * float(i) / float(steps);
    for (float w : {-0.3f, 0.3f}) {
      float const r = 1 + w * std::cos(a / 2);
      mesh.positions.push_back({r * std::cos(a), w * std::sin(a / 2), -r * std::sin(a)});
    }
  }
  for (int i = 0; i + 1 < steps; ++i) quad(mesh, 2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1);
  quad(mesh, 2 * steps - 2, 1, 0, 2 * steps - 1);  // the half turn
  return mesh;
}

TriMesh sliver() { return {{{0, 0, 0}, {1, 0, 0}, {0.5f, 1e-6f, 0}}, {{0, 1, 2}}}; }

TriMesh non_manifold_edge() {
  return {{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {-1, 0, 1}, {-1, 0, -1}}, {{0, 2, 1}, {0, 3, 1}, {0, 4, 1}}};
}

TriMesh two_shells() {
  TriMesh mesh = cube({-2, 0, 0});
  TriMesh const other = cube({2, 0, 0});
  for (Triangle t : other.triangles) mesh.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
  mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
  return mesh;
}

SourceModel plain_model(TriMesh mesh) {
  SourceModel model;
  model.mesh = std::move(mesh);
  return model;
}

SourceModel painted_model(TriMesh mesh) {
  SourceModel model = plain_model(std::move(mesh));
  auto wave = [](float x) { return static_cast<std::uint16_t>(32767.5f + 30000 * std::sin(x)); };
  for (V3f const& p : model.mesh.positions)
    model.colours.push_back({wave(3 * p.x), wave(4 * p.y + 1), wave(5 * p.z + 2), 65535});
  return model;
}

}  // namespace vitrine::test
