// SPDX-License-Identifier: Apache-2.0
#include "io/mesh_codec.h"

#include "stages/error.h"

#include <draco/compression/expert_encode.h>
#include <draco/mesh/mesh.h>

#include <limits>
#include <memory>
#include <string>

namespace vitrine::io {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Tangents are axes with w = 1: each component is 0 or 1.
constexpr int kTangentBits = 1;

V4f with_w(V3f const& tangent) { return {tangent.x, tangent.y, tangent.z, 1}; }

/// Plain parallelograms are up to 6 % smaller below some 2500 triangles, several constrained ones 3 % above 6000.
struct Attempt {
  int method, prediction;
};
constexpr Attempt kAttempts[] = {
    {draco::MESH_EDGEBREAKER_ENCODING, draco::MESH_PREDICTION_CONSTRAINED_MULTI_PARALLELOGRAM},
    {draco::MESH_EDGEBREAKER_ENCODING, draco::MESH_PREDICTION_PARALLELOGRAM},
    {draco::MESH_SEQUENTIAL_ENCODING, draco::PREDICTION_DIFFERENCE}};

/// Adds a float attribute with one value per point; returns its unique id.
template <class Vector>
int add_attribute(draco::Mesh& mesh, draco::GeometryAttribute::Type type, std::vector<Vector> const& values) {
  draco::GeometryAttribute attribute;
  attribute.Init(type, nullptr, Vector::dimensions(), draco::DT_FLOAT32, false, sizeof(Vector), 0);
  int const id = mesh.AddAttribute(attribute, true, static_cast<std::uint32_t>(values.size()));
  for (std::uint32_t i = 0; i < values.size(); ++i)
    mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i), &values[i]);
  return static_cast<int>(mesh.attribute(id)->unique_id());
}

std::unique_ptr<draco::Mesh> build(VertexMesh const& mesh, DracoMesh& ids) {
  auto result = std::make_unique<draco::Mesh>();
  draco::Mesh& built = *result;
  built.set_num_points(static_cast<std::uint32_t>(mesh.positions.size()));
  built.SetNumFaces(mesh.triangles.size());
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    Triangle const& t = mesh.triangles[f];
    built.SetFace(draco::FaceIndex(f), {draco::PointIndex(t[0]), draco::PointIndex(t[1]), draco::PointIndex(t[2])});
  }
  ids.position_id = add_attribute(built, draco::GeometryAttribute::POSITION, mesh.positions);
  if (!mesh.normals.empty()) ids.normal_id = add_attribute(built, draco::GeometryAttribute::NORMAL, mesh.normals);
  if (!mesh.tangents.empty()) ids.tangent_id = add_attribute(built, draco::GeometryAttribute::GENERIC, mesh.tangents);
  if (!mesh.uvs.empty()) ids.uv_id = add_attribute(built, draco::GeometryAttribute::TEX_COORD, mesh.uvs);
  if (!mesh.colours.empty()) ids.colour_id = add_attribute(built, draco::GeometryAttribute::COLOR, mesh.colours);
  // Edgebreaker walks over equal positions, not over vertices: seams then cost only the attributes that differ.
  if (!built.DeduplicateAttributeValues())
    throw Error(ErrorKind::broken, "draco cannot merge equal attributes", "report this model");
  built.DeduplicatePointIds();
  return result;
}

int position_attribute(draco::Mesh const& mesh) { return mesh.GetNamedAttributeId(draco::GeometryAttribute::POSITION); }

/// Fixes the steps of each attribute, so that equal values are equal in every file and on every client.
void use_grid(draco::ExpertEncoder& encoder, draco::Mesh const& mesh, Grid const& grid) {
  V4f const least(0, 0, 0, 0);
  int const uv = mesh.GetNamedAttributeId(draco::GeometryAttribute::TEX_COORD);
  int const normal = mesh.GetNamedAttributeId(draco::GeometryAttribute::NORMAL);
  int const colour = mesh.GetNamedAttributeId(draco::GeometryAttribute::COLOR);
  encoder.SetAttributeExplicitQuantization(position_attribute(mesh), grid.position_bits, 3, grid.origin.getValue(),
                                           grid.range);
  if (uv >= 0) encoder.SetAttributeExplicitQuantization(uv, grid.uv_bits, 2, &least.x, 1);
  if (colour >= 0) encoder.SetAttributeExplicitQuantization(colour, grid.colour_bits, 3, &least.x, 1);
  int const tangent = mesh.GetNamedAttributeId(draco::GeometryAttribute::GENERIC);
  if (normal >= 0) encoder.SetAttributeQuantization(normal, grid.normal_bits);
  if (tangent >= 0) encoder.SetAttributeExplicitQuantization(tangent, kTangentBits, 4, &least.x, 1);
}

}  // namespace

VertexMesh split_vertices(BakedModel const& model) {
  VertexMesh split;
  split.palette = model.palette;
  std::vector<std::uint32_t> first(model.mesh.positions.size(), kNone);  // per welded vertex: its newest copy
  std::vector<std::uint32_t> next;                                       // per copy: the one made before it
  auto copy_of = [&](std::uint32_t vertex, V2f const* uv, V3f const* tangent) {
    auto const is_it = [&](std::uint32_t copy) {
      return (!uv || split.uvs[copy] == *uv) && (!tangent || split.tangents[copy] == with_w(*tangent));
    };
    std::uint32_t copy = first[vertex];
    while (copy != kNone && !is_it(copy)) copy = next[copy];
    if (copy != kNone) return copy;
    copy = static_cast<std::uint32_t>(split.positions.size());
    split.positions.push_back(model.mesh.positions[vertex]);
    if (!model.normals.empty()) split.normals.push_back(model.normals[vertex]);
    if (!model.colours.empty()) split.colours.push_back(model.colours[vertex]);
    if (tangent) split.tangents.push_back(with_w(*tangent));
    if (uv) split.uvs.push_back(*uv);
    next.push_back(first[vertex]);
    return first[vertex] = copy;
  };
  split.triangles.reserve(model.mesh.triangles.size());
  for (std::size_t f = 0; f < model.mesh.triangles.size(); ++f) {
    V3f const* const tangent = model.chart_tangents.empty() ? nullptr : &model.chart_tangents[model.face_charts[f]];
    Triangle corners;
    for (std::size_t c = 0; c < 3; ++c)
      corners[c] =
          copy_of(model.mesh.triangles[f][c], model.corner_uvs.empty() ? nullptr : &model.corner_uvs[f][c], tangent);
    split.triangles.push_back(corners);
  }
  return split;
}

DracoMesh encode_draco(VertexMesh const& mesh, Grid const& grid) {
  if (mesh.triangles.empty() || !(grid.range > 0))
    throw Error(ErrorKind::broken,
                "nothing to encode: " + std::to_string(mesh.triangles.size()) + " triangles on a grid of edge " +
                    std::to_string(grid.range),
                "report this model");
  DracoMesh result;
  std::unique_ptr<draco::Mesh> const built = build(mesh, result);
  draco::Status status;
  for (Attempt const& attempt : kAttempts) {
    if (attempt.method == draco::MESH_SEQUENTIAL_ENCODING && !result.bytes.empty()) break;
    draco::ExpertEncoder encoder(*built);
    encoder.SetEncodingMethod(attempt.method);
    encoder.SetSpeedOptions(0, 0);
    encoder.SetTrackEncodedProperties(true);
    use_grid(encoder, *built, grid);
    (void)encoder.SetAttributePredictionScheme(position_attribute(*built), attempt.prediction);
    if (mesh.palette)  // the default, made for charts, takes 15 to 30 % more
      (void)encoder.SetAttributePredictionScheme(built->GetNamedAttributeId(draco::GeometryAttribute::TEX_COORD),
                                                 draco::PREDICTION_DIFFERENCE);
    draco::EncoderBuffer buffer;
    status = encoder.EncodeToBuffer(&buffer);
    if (!status.ok() || (!result.bytes.empty() && result.bytes.size() <= buffer.size())) continue;
    auto const bytes = std::as_bytes(std::span(buffer.data(), buffer.size()));
    result.bytes.assign(bytes.begin(), bytes.end());
    result.vertices = static_cast<std::uint32_t>(encoder.num_encoded_points());
    result.triangles = static_cast<std::uint32_t>(encoder.num_encoded_faces());
  }
  if (!result.bytes.empty()) return result;
  throw Error(ErrorKind::broken, std::string("draco cannot encode the mesh: ") + status.error_msg(),
              "report this model");
}

}  // namespace vitrine::io
