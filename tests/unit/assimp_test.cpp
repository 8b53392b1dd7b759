// SPDX-License-Identifier: Apache-2.0
// Thumbnails in an importer of another kind: that of assimp, which knows no KHR_mesh_quantization.
#include "io/write_glb.h"
#include "tests/support/delivered.h"

#include <assimp/mesh.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include <gtest/gtest.h>

namespace vitrine::io {
namespace {

BakedModel textured() {
  BakedModel model = test::random_model(5);
  Image colour{16, 16, 3, ColourSpace::srgb, {}};
  colour.texels.assign(16 * 16 * 3, 120);
  model.colour = colour;
  model.chart_tangents.clear();
  return model;
}

struct Imported {
  explicit Imported(Profile profile) {
    std::vector<std::byte> const glb = encode(textured(), "sphere", {.profile = profile}).glb;
    scene = importer.ReadFileFromMemory(glb.data(), glb.size(),
                                        aiProcess_PreTransformVertices | aiProcess_GenBoundingBoxes, "glb");
  }
  Assimp::Importer importer;
  aiScene const* scene;
};

TEST(Assimp, LoadsCoreThumbnailsWhereTheyAre) {
  Imported const imported(Profile::core);
  ASSERT_NE(imported.scene, nullptr) << imported.importer.GetErrorString();
  ASSERT_EQ(imported.scene->mNumMeshes, 1u);
  aiMesh const& mesh = *imported.scene->mMeshes[0];
  BakedModel const model = textured();
  EXPECT_EQ(mesh.mNumFaces, model.mesh.triangles.size());
  EXPECT_TRUE(mesh.HasNormals() && mesh.HasTextureCoords(0));
  EXPECT_EQ(imported.scene->mNumTextures, 1u);
  Box3f box;
  for (V3f const& p : model.mesh.positions) box.extendBy(p);
  for (unsigned k = 0; k < 3; ++k) {
    EXPECT_FLOAT_EQ(mesh.mAABB.mMin[k], box.min[k]);
    EXPECT_FLOAT_EQ(mesh.mAABB.mMax[k], box.max[k]);
  }
}

TEST(Assimp, OpensPlainThumbnailsWithAllTheirTriangles) {
  Imported const imported(Profile::plain);
  ASSERT_NE(imported.scene, nullptr) << imported.importer.GetErrorString();
  EXPECT_EQ(imported.scene->mMeshes[0]->mNumFaces, textured().mesh.triangles.size());
}

}  // namespace
}  // namespace vitrine::io
