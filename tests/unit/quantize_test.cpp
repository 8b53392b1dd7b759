// SPDX-License-Identifier: Apache-2.0
#include "stages/quantize.h"

#include "stages/error.h"
#include "tests/support/meshes.h"

#include <draco/attributes/attribute_quantization_transform.h>
#include <draco/compression/attributes/normal_compression_utils.h>
#include <draco/compression/decode.h>
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gmock/gmock.h>

#include <random>

namespace vitrine {
namespace {

/// One chart a face, none of them meant to be looked at.
Atlas atlas_of(TriMesh mesh, float uv_scale = 1) {
  Atlas atlas{std::move(mesh), {}, 0, {}, 256, 256, 2, 0};
  atlas.charts = std::uint32_t(atlas.mesh.triangles.size());
  for (std::uint32_t f = 0; f < atlas.charts; ++f) {
    atlas.face_charts.push_back(f);
    float const at = uv_scale * float(f) / float(atlas.charts);
    atlas.corner_uvs.push_back({V2f(at, at), V2f(at + 0.01f, at), V2f(at, at + 0.0137f)});
  }
  return atlas;
}

/// What a client gets: the soup encoded on the grid and decoded.
std::pair<std::vector<V3f>, std::vector<V2f>> through_draco(QuantizedAtlas const& q) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(int(q.atlas.mesh.triangles.size()));
  int const position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  int const uv = builder.AddAttribute(draco::GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32);
  for (std::uint32_t f = 0; f < q.atlas.mesh.triangles.size(); ++f) {
    Triangle const& t = q.atlas.mesh.triangles[f];
    auto const& p = q.atlas.mesh.positions;
    auto const& c = q.atlas.corner_uvs[f];
    builder.SetAttributeValuesForFace(position, draco::FaceIndex(f), &p[t[0]], &p[t[1]], &p[t[2]]);
    builder.SetAttributeValuesForFace(uv, draco::FaceIndex(f), &c[0], &c[1], &c[2]);
  }
  draco::Encoder encoder;
  encoder.SetEncodingMethod(draco::MESH_SEQUENTIAL_ENCODING);  // keeps the order of faces
  std::array<float, 3> const origin{q.grid.origin.x, q.grid.origin.y, q.grid.origin.z}, zero{};
  encoder.SetAttributeExplicitQuantization(draco::GeometryAttribute::POSITION, q.grid.position_bits, 3, origin.data(),
                                           q.grid.range);
  encoder.SetAttributeExplicitQuantization(draco::GeometryAttribute::TEX_COORD, q.grid.uv_bits, 2, zero.data(), 1);
  draco::EncoderBuffer bytes;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(*builder.Finalize(), &bytes).ok());
  draco::DecoderBuffer in;
  in.Init(bytes.data(), bytes.size());
  auto const mesh = draco::Decoder().DecodeMeshFromBuffer(&in).value();
  std::pair<std::vector<V3f>, std::vector<V2f>> corners;
  for (draco::FaceIndex f(0); f < mesh->num_faces(); ++f)
    for (draco::PointIndex const& point : mesh->face(f)) {
      auto const* const p = mesh->GetNamedAttribute(draco::GeometryAttribute::POSITION);
      auto const* const t = mesh->GetNamedAttribute(draco::GeometryAttribute::TEX_COORD);
      p->GetValue(p->mapped_index(point), &corners.first.emplace_back());
      t->GetValue(t->mapped_index(point), &corners.second.emplace_back());
    }
  return corners;
}

class AtBits : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Quantize, AtBits, testing::Values(6, 8, 11, 14, 16));

TEST_P(AtBits, PositionsAndUvsAreWhatDracoDecodes) {
  TriMesh mesh = test::bumpy_sphere(16, 8);
  for (V3f& p : mesh.positions) p = p * 37.3f + V3f(11.7f, -3.9f, 100.1f);
  Atlas atlas = atlas_of(mesh);
  atlas.gutter = 16;
  QuantizedAtlas const q = quantize(atlas, {GetParam(), GetParam(), 8});
  auto const [positions, uvs] = through_draco(q);
  ASSERT_EQ(positions.size(), 3 * q.atlas.mesh.triangles.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    ASSERT_EQ(positions[i], q.atlas.mesh.positions[q.atlas.mesh.triangles[i / 3][i % 3]]) << i;
    ASSERT_EQ(uvs[i], q.atlas.corner_uvs[i / 3][i % 3]) << i;
  }
}

TEST_P(AtBits, NormalsAreWhatDracoDecodes) {
  int const bits = std::min(GetParam(), 14);
  draco::OctahedronToolBox box;
  ASSERT_TRUE(box.SetQuantizationBits(bits));
  std::mt19937 random(5);
  std::uniform_real_distribution<float> coordinate(-1, 1);
  std::vector<V3f> normals{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0},        {0, -1, 0},
                           {0, 0, 1}, {0, 0, -1}, {-0.6f, 0.8f, 0}, {-0.6f, 0, -0.8f}};
  for (int i = 0; i < 5000; ++i)
    normals.push_back(V3f(coordinate(random), coordinate(random), coordinate(random)).normalized());
  for (V3f const& normal : normals) {
    int s = 0, t = 0;
    V3f decoded;
    box.FloatVectorToQuantizedOctahedralCoords(&normal.x, &s, &t);
    box.QuantizedOctahedralCoordsToUnitVector(s, t, &decoded.x);
    V3f const ours = quantize_normal(normal, bits);
    ASSERT_EQ(ours, decoded) << normal;
    ASSERT_EQ(quantize_normal(ours, bits), ours) << "encoding what was decoded moved " << normal;
  }
}

TEST(Quantize, MovesNoCoordinateByMoreThanHalfAStep) {
  TriMesh const mesh = test::bumpy_sphere(16, 8);
  QuantizedAtlas const q = quantize(atlas_of(mesh), {10, 12, 8});
  float const half = q.grid.range / 1023 / 2 * 1.001f;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      V3f const moved = q.atlas.mesh.positions[q.atlas.mesh.triangles[f][k]] - mesh.positions[mesh.triangles[f][k]];
      EXPECT_LE(std::max({std::abs(moved.x), std::abs(moved.y), std::abs(moved.z)}), half);
    }
}

TEST(Quantize, FacesThatLoseTheirAreaGoWithTheirCorners) {
  TriMesh mesh = test::cube();
  mesh.positions.push_back({0.5f, 0.5f, 0.5001f});
  mesh.triangles.insert(mesh.triangles.begin() + 5, {7, 6, 8});
  Atlas const atlas = atlas_of(mesh);
  QuantizedAtlas const q = quantize(atlas, {8, 11, 8});
  EXPECT_EQ(q.atlas.mesh.triangles.size(), 12u);
  EXPECT_EQ(q.atlas.mesh.positions.size(), 8u);
  EXPECT_EQ(q.atlas.face_charts[5], 6u);
  EXPECT_NEAR(q.atlas.corner_uvs[5][0].x, atlas.corner_uvs[6][0].x, 1.0 / 2047);
}

TEST(Quantize, AMeshWithoutAnAtlasComesToTheSamePlaces) {
  TriMesh const mesh = test::bumpy_sphere(32, 16);
  QuantizedMesh const plain = quantize(mesh, cube_about(mesh, 6));
  QuantizedAtlas const atlas = quantize(atlas_of(mesh), {6, 11, 8});
  EXPECT_EQ(plain.mesh.positions, atlas.atlas.mesh.positions);
  EXPECT_EQ(plain.mesh.triangles, atlas.atlas.mesh.triangles);
  EXPECT_EQ(plain.grid.range, atlas.grid.range);
  EXPECT_LT(plain.mesh.positions.size(), mesh.positions.size()) << "nothing met";
}

TEST(Quantize, VerticesThatMeetBecomeOne) {
  TriMesh const mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1e-4f, 0}, {1, 1, 0}, {1e-4f, 1, 0}},
                     {{0, 1, 2}, {3, 4, 5}}};
  EXPECT_THAT(quantize(atlas_of(mesh), {8, 11, 8}).atlas.mesh.triangles,
              testing::ElementsAre(Triangle{0, 1, 2}, Triangle{1, 3, 2}));
}

TEST(Quantize, RefusesUvStepsThatCouldJoinCharts) {
  EXPECT_NO_THROW(quantize(atlas_of(test::cube()), {11, 8, 8}));
  EXPECT_THROW(quantize(atlas_of(test::cube()), {11, 7, 8}), Error);
}

TEST(Quantize, RefusesAMeshWithoutExtent) {
  EXPECT_THROW(quantize(atlas_of({{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, {{0, 1, 2}}})), Error);
}

}  // namespace
}  // namespace vitrine
