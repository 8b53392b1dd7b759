// SPDX-License-Identifier: Apache-2.0
#include "tests/support/delivered.h"

#include "tests/support/meshes.h"

#include <draco/compression/decode.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

namespace vitrine::test {
namespace {

/// The float that a decoder finds for the step nearest to `value`.
float snap(float value, float origin, float range, int bits) {
  float const step = range / float((1 << bits) - 1);
  return origin + std::round((value - origin) / step) * step;
}

template <class Vector>
std::vector<Vector> values(draco::Mesh const& mesh, draco::GeometryAttribute::Type type) {
  draco::PointAttribute const* attribute = mesh.GetNamedAttribute(type);
  std::vector<Vector> result(attribute ? mesh.num_points() : 0);
  for (std::uint32_t i = 0; i < result.size(); ++i)
    attribute->GetValue(attribute->mapped_index(draco::PointIndex(i)), &result[i][0]);
  return result;
}

}  // namespace

BakedModel random_model(unsigned seed, int slices, int stacks) {
  BakedModel model;
  model.mesh = bumpy_sphere(slices, stacks, seed);
  model.grid = {{-1.5f, -1.25f, -1.5f}, 3, 11, 11, 8};
  for (V3f& p : model.mesh.positions)
    for (unsigned k = 0; k < 3; ++k)
      p[k] = snap(p[k], model.grid.origin[k], model.grid.range, model.grid.position_bits);
  for (V3f const& p : model.mesh.positions) model.normals.push_back(p.normalized());

  model.chart_tangents = {{1, 0, 0}, {0, 0, 1}};

  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(-1, 1);
  V3f const cut = V3f(unit(random), unit(random), unit(random)).normalized();
  for (Triangle const& t : model.mesh.triangles) {
    V3f const centre = (model.mesh.positions[t[0]] + model.mesh.positions[t[1]] + model.mesh.positions[t[2]]) / 3;
    bool const far = centre.dot(cut) < 0;
    float const shift = far ? 0.25f : 0.75f;
    model.face_charts.push_back(far);
    CornerUvs uvs;
    for (std::size_t c = 0; c < 3; ++c) {
      V3f const& p = model.mesh.positions[t[c]];
      uvs[c] = {snap(shift + 0.1f * p.x, 0, 1, 11), snap(0.5f + 0.3f * p.y, 0, 1, 11)};
    }
    model.corner_uvs.push_back(uvs);
  }
  return model;
}

BakedModel coloured_model(unsigned seed) {
  BakedModel const whole = random_model(seed);
  BakedModel model;
  model.mesh = whole.mesh;
  model.grid = whole.grid;
  model.grid.colour_bits = 5;
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> code(0, 31);
  for (std::size_t v = 0; v < model.mesh.positions.size(); ++v)
    model.colours.push_back(V3f(float(code(random)), float(code(random)), float(code(random))) * (1.f / 31));
  return model;
}

io::VertexMesh decode_draco(std::span<std::byte const> bytes) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<char const*>(bytes.data()), bytes.size());
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok()) throw std::runtime_error(decoded.status().error_msg_string());
  draco::Mesh const& from = *decoded.value();
  io::VertexMesh mesh{values<V3f>(from, draco::GeometryAttribute::POSITION),
                      values<V3f>(from, draco::GeometryAttribute::NORMAL),
                      values<Imath::V4f>(from, draco::GeometryAttribute::GENERIC),
                      values<V2f>(from, draco::GeometryAttribute::TEX_COORD),
                      values<V3f>(from, draco::GeometryAttribute::COLOR),
                      {}};
  for (std::uint32_t f = 0; f < from.num_faces(); ++f) {
    auto const& face = from.face(draco::FaceIndex(f));
    mesh.triangles.push_back({face[0].value(), face[1].value(), face[2].value()});
  }
  return mesh;
}

std::vector<Corners> corners(io::VertexMesh const& mesh) {
  std::vector<Corners> all;
  for (Triangle const& t : mesh.triangles) {
    Corners triangle;
    for (std::size_t c = 0; c < 3; ++c) {
      V3f const& p = mesh.positions[t[c]];
      V2f const uv = mesh.uvs.empty() ? V2f(0) : mesh.uvs[t[c]];
      Imath::V4f const tangent = mesh.tangents.empty() ? Imath::V4f(0) : mesh.tangents[t[c]];
      V3f const colour = mesh.colours.empty() ? V3f(0) : mesh.colours[t[c]];
      triangle[c] = {p.x,       p.y,       p.z,       uv.x,     uv.y,     tangent.x,
                     tangent.y, tangent.z, tangent.w, colour.x, colour.y, colour.z};
    }
    std::rotate(triangle.begin(), std::ranges::min_element(triangle), triangle.end());
    all.push_back(triangle);
  }
  std::ranges::sort(all);
  return all;
}

}  // namespace vitrine::test
