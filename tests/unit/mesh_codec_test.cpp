// SPDX-License-Identifier: Apache-2.0
#include "io/mesh_codec.h"

#include "stages/error.h"
#include "tests/support/delivered.h"
#include "tests/support/meshes.h"

#include <gmock/gmock.h>

namespace vitrine::io {
namespace {

using test::coloured_model;
using test::corners;
using test::decode_draco;
using test::random_model;

BakedModel bare(TriMesh mesh) {
  BakedModel model;
  model.mesh = std::move(mesh);
  model.grid = {{-2, -2, -2}, 4, 11, 11, 8};
  return model;
}

TEST(SplitVertices, WithoutUvsKeepsTheWeldedVertices) {
  VertexMesh const split = split_vertices(bare(test::cube()));
  EXPECT_EQ(split.positions.size(), 8u);
  EXPECT_EQ(split.triangles.size(), 12u);
  EXPECT_THAT(split.uvs, testing::IsEmpty());
}

TEST(SplitVertices, MakesOneVertexPerPositionAndUv) {
  BakedModel model = bare(test::grid(1, 1));  // two faces on one diagonal
  model.corner_uvs = {{V2f{0, 0}, {0, 1}, {1, 1}}, {V2f{0, 0}, {1, 1}, {1, 0}}};
  EXPECT_EQ(split_vertices(model).positions.size(), 4u);
  model.corner_uvs[1] = {V2f{0, 0}, {0.5f, 0.5f}, {1, 0}};  // a seam at one end of the diagonal
  EXPECT_EQ(split_vertices(model).positions.size(), 5u);
}

TEST(SplitVertices, KeepsChartsOfDifferentTangentsApart) {
  BakedModel model = bare(test::grid(1, 1));
  model.face_charts = {0, 1};
  model.chart_tangents = {{1, 0, 0}, {0, 1, 0}};
  VertexMesh const split = split_vertices(model);
  EXPECT_EQ(split.positions.size(), 6u);
  EXPECT_EQ(split.tangents[split.triangles[0][0]], Imath::V4f(1, 0, 0, 1));
  EXPECT_EQ(split.tangents[split.triangles[1][0]], Imath::V4f(0, 1, 0, 1));
  model.chart_tangents[1] = {1, 0, 0};
  EXPECT_EQ(split_vertices(model).positions.size(), 4u);
}

TEST(SplitVertices, NumbersByFirstUseAndDropsTheUnused) {
  BakedModel model = bare({{{0, 0, 0}, {9, 9, 9}, {1, 0, 0}, {0, 1, 0}}, {{3, 0, 2}}});
  model.normals = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}};
  VertexMesh const split = split_vertices(model);
  EXPECT_THAT(split.triangles, testing::ElementsAre(Triangle{0, 1, 2}));
  EXPECT_THAT(split.positions, testing::ElementsAre(V3f(0, 1, 0), V3f(0, 0, 0), V3f(1, 0, 0)));
  EXPECT_THAT(split.normals, testing::ElementsAre(V3f(0, 0, -1), V3f(1, 0, 0), V3f(0, 0, 1)));
}

TEST(EncodeDraco, DecodesToTheGridExactly) {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    BakedModel const model = random_model(seed);
    VertexMesh const mesh = split_vertices(model);
    DracoMesh const coded = encode_draco(mesh, model.grid);
    VertexMesh const decoded = decode_draco(coded.bytes);
    EXPECT_EQ(decoded.triangles.size(), mesh.triangles.size());
    EXPECT_EQ(corners(decoded), corners(mesh));
  }
}

TEST(EncodeDraco, KeepsColoursOfTheGridExactly) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    BakedModel const model = coloured_model(seed);
    VertexMesh const mesh = split_vertices(model);
    EXPECT_EQ(mesh.positions.size(), model.mesh.positions.size());
    EXPECT_EQ(corners(decode_draco(encode_draco(mesh, model.grid).bytes)), corners(mesh));
  }
}

TEST(EncodeDraco, PacksPalettesAsColours) {
  BakedModel model = bare(test::bumpy_sphere(48, 24));
  model.grid.uv_bits = 5;
  for (Triangle const& t : model.mesh.triangles) {
    CornerUvs uvs;
    for (std::size_t c = 0; c < 3; ++c) {
      V3f const& p = model.mesh.positions[t[c]];
      uvs[c] = {0.5f + 0.25f * std::sin(9 * p.x) * std::cos(7 * p.y), 0.5f + 0.1f * std::sin(8 * p.z)};
    }
    model.corner_uvs.push_back(uvs);
  }
  std::size_t const as_charts = encode_draco(split_vertices(model), model.grid).bytes.size();
  model.palette = true;
  EXPECT_LT(encode_draco(split_vertices(model), model.grid).bytes.size(), as_charts - 50);
}

TEST(EncodeDraco, StaysWithinHalfAStepOffTheGrid) {
  BakedModel const model = bare(test::bumpy_sphere(24, 12));
  VertexMesh const mesh = split_vertices(model);
  VertexMesh const decoded = decode_draco(encode_draco(mesh, model.grid).bytes);
  float const half_step = 0.5f * 4 / 2047;
  for (V3f const& p : decoded.positions) {
    float nearest = 1;
    for (V3f const& q : mesh.positions) {
      V3f const d = p - q;
      nearest = std::min(nearest, std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}));
    }
    EXPECT_LE(nearest, half_step * 1.001f);
  }
}

TEST(EncodeDraco, KeepsNormalsWithinTheirBits) {
  BakedModel model = bare(test::sphere());
  model.normals = model.mesh.positions;
  VertexMesh const decoded = decode_draco(encode_draco(split_vertices(model), model.grid).bytes);
  ASSERT_EQ(decoded.normals.size(), decoded.positions.size());
  for (std::size_t i = 0; i < decoded.normals.size(); ++i)
    EXPECT_GT(decoded.normals[i].dot(decoded.positions[i].normalized()), std::cos(0.015f));
}

TEST(EncodeDraco, TangentsAreNearlyFree) {
  BakedModel model = random_model(1, 48, 32);
  std::size_t const with = encode_draco(split_vertices(model), model.grid).bytes.size();
  model.chart_tangents.clear();
  std::size_t const without = encode_draco(split_vertices(model), model.grid).bytes.size();
  EXPECT_LT(with - without, without / 20);
}

TEST(EncodeDraco, ReportsWhatADecoderFinds) {
  for (TriMesh const& mesh :
       {test::cube(), test::moebius(), test::non_manifold_edge(), test::two_shells(), test::torus()}) {
    DracoMesh const coded = encode_draco(split_vertices(bare(mesh)), {{-3, -3, -3}, 6, 11, 11, 8});
    VertexMesh const decoded = decode_draco(coded.bytes);
    EXPECT_EQ(coded.vertices, decoded.positions.size());
    EXPECT_EQ(coded.triangles, decoded.triangles.size());
    EXPECT_EQ(coded.triangles, mesh.triangles.size());
  }
}

TEST(EncodeDraco, GivesTheSameBytesAgain) {
  BakedModel const model = random_model(3);
  EXPECT_EQ(encode_draco(split_vertices(model), model.grid).bytes,
            encode_draco(split_vertices(model), model.grid).bytes);
}

TEST(EncodeDraco, StoresSequentiallyWhatEdgebreakerRefuses) {
  VertexMesh const collapsed{{{0, 0, 0}, {1, 0, 0}}, {}, {}, {}, {}, {{0, 1, 1}}};
  DracoMesh const coded = encode_draco(collapsed, {{0, 0, 0}, 1, 8, 8, 8});
  EXPECT_EQ(std::to_integer<int>(coded.bytes[8]), 0);  // the header's method: 0 sequential, 1 edgebreaker
  EXPECT_EQ(decode_draco(coded.bytes).triangles.size(), coded.triangles);
}

TEST(EncodeDraco, RefusesAnEmptyMesh) {
  EXPECT_THROW(encode_draco({}, {{0, 0, 0}, 1, 8, 8, 8}), Error);
  EXPECT_THROW(encode_draco(split_vertices(bare(test::triangle())), {{0, 0, 0}, 0, 8, 8, 8}), Error);
}

}  // namespace
}  // namespace vitrine::io
