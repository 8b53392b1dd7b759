// SPDX-License-Identifier: Apache-2.0
#include "io/glb_parts.h"

#include "stages/error.h"

#include <gmock/gmock.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace vitrine::io {
namespace {

/// A GLB of this JSON with a binary chunk of that many zeros.
std::vector<std::byte> glb(std::string json, std::size_t binary) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::uint32_t const total = std::uint32_t(28 + json.size() + binary);
  std::uint32_t const head[5] = {0x46546c67, 2, total, std::uint32_t(json.size()), 0x4e4f534a};
  std::uint32_t const chunk[2] = {std::uint32_t(binary), 0x004e4942};
  std::vector<std::byte> bytes(total);
  std::memcpy(bytes.data(), head, sizeof head);
  std::memcpy(bytes.data() + 20, json.data(), json.size());
  std::memcpy(bytes.data() + 20 + json.size(), chunk, sizeof chunk);
  return bytes;
}

TEST(GlbParts, ImagesCountForWhatTheyShowAndTheRestForGeometry) {
  auto const file = glb(R"({"bufferViews":[{"byteLength":100},{"byteLength":20},{"byteLength":30},{"byteLength":4}],
    "images":[{"bufferView":1},{"bufferView":2},{"bufferView":3}],
    "textures":[{"source":0},{"extensions":{"EXT_texture_webp":{"source":1}}},{"source":2}],
    "materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}},"normalTexture":{"index":1},
                  "occlusionTexture":{"index":2}}]})",
                        200);
  GlbParts const parts = glb_parts(file);
  EXPECT_EQ(parts.geometry, 100u);
  EXPECT_EQ(parts.colour, 20u);
  EXPECT_EQ(parts.normal, 30u);
  EXPECT_EQ(parts.occlusion, 4u);
  EXPECT_EQ(parts.other, file.size() - 154);
}

TEST(GlbParts, MeshoptViewsCountTheirCompressedBytes) {
  auto const file =
      glb(R"({"bufferViews":[{"byteLength":5000,"extensions":{"EXT_meshopt_compression":{"byteLength":60}}}]})", 60);
  EXPECT_EQ(glb_parts(file).geometry, 60u);
}

TEST(GlbParts, AnImageWithTwoUsesCountsOnce) {
  auto const file = glb(R"({"bufferViews":[{"byteLength":8}],"images":[{"bufferView":0}],"textures":[{"source":0}],
    "materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}},"normalTexture":{"index":0}}]})",
                        8);
  EXPECT_EQ(glb_parts(file).colour, 8u);
  EXPECT_EQ(glb_parts(file).normal, 0u);
}

TEST(GlbParts, RefusesWhatIsNoGlb) {
  EXPECT_THROW(glb_parts(std::vector<std::byte>(10)), Error);
  EXPECT_THROW(glb_parts(glb("[]", 0)), Error);
  EXPECT_THROW(glb_parts(glb("{", 0)), Error);
  auto cut = glb(R"({"asset":{}})", 0);
  cut.resize(25);
  EXPECT_THROW(glb_parts(cut), Error);
}

TEST(GlbParts, RefusesViewsThatClaimMoreThanThereIs) {
  EXPECT_THROW(glb_parts(glb(R"({"bufferViews":[{"byteLength":99999}]})", 8)), Error);
  EXPECT_THROW(glb_parts(glb(R"({"bufferViews":[{"byteLength":-1}]})", 8)), Error);
}

TEST(GlbParts, IndicesThatLeadNowhereAreOther) {
  auto const file = glb(R"({"bufferViews":[{"byteLength":8}],"images":[{"bufferView":7}],"textures":[{"source":9}],
    "materials":[{"normalTexture":{"index":0}},{"normalTexture":{"index":5}},7]})",
                        8);
  EXPECT_EQ(glb_parts(file).geometry, 8u);
}

}  // namespace
}  // namespace vitrine::io
