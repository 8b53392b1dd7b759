// SPDX-License-Identifier: Apache-2.0
#include "io/image_codec.h"
#include "io/mesh_codec.h"
#include "io/read_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

using namespace vitrine;
using namespace vitrine::io;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using Doc = nlohmann::json;

namespace {

template <class T>
std::string raw(std::vector<T> const& values) {
  return {reinterpret_cast<char const*>(values.data()), values.size() * sizeof(T)};
}

/// A document that grows by buffers, views and accessors; one buffer per accessor keeps it readable.
struct Builder {
  Doc json = {{"asset", {{"version", "2.0"}}}, {"scenes", {{{"nodes", {0}}}}}, {"nodes", {{{"mesh", 0}}}}};
  std::string bytes;

  int view(std::string const& data) {
    bytes.resize((bytes.size() + 3) / 4 * 4);
    json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", data.size()}});
    bytes += data;
    return static_cast<int>(json["bufferViews"].size()) - 1;
  }

  template <class T>
  int accessor(char const* type, int component, std::size_t components, std::vector<T> const& values) {
    json["accessors"].push_back({{"bufferView", view(raw(values))},
                                 {"componentType", component},
                                 {"count", values.size() / components},
                                 {"type", type}});
    return static_cast<int>(json["accessors"].size()) - 1;
  }

  Doc& primitive() { return json["meshes"][0]["primitives"][0]; }

  std::string text() {
    json["buffers"] = {{{"byteLength", bytes.size()}, {"uri", "data:application/octet-stream;base64," + base64()}}};
    return json.dump();
  }

  std::string glb() {
    json["buffers"] = {{{"byteLength", bytes.size()}}};
    std::string head = json.dump();
    head.resize((head.size() + 3) / 4 * 4, ' ');
    auto const word = [](std::size_t v) { return raw(std::vector<std::uint32_t>{static_cast<std::uint32_t>(v)}); };
    return "glTF" + word(2) + word(28 + head.size() + bytes.size()) + word(head.size()) + "JSON" + head +
           word(bytes.size()) + std::string("BIN\0", 4) + bytes;
  }

 private:
  std::string base64() const {
    static char const digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
      std::uint32_t word = 0;
      for (std::size_t k = 0; k < 3; ++k)
        word = word << 8 | (i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0u);
      for (int k = 0; k < 4; ++k) out += digits[word >> (18 - 6 * k) & 63];
    }
    if (bytes.size() % 3 > 0)
      out.replace(out.size() - (3 - bytes.size() % 3), 3 - bytes.size() % 3, 3 - bytes.size() % 3, '=');
    return out;
  }
};

/// One square in the xy plane, facing +Z.
Builder square() {
  Builder b;
  int const positions = b.accessor<float>("VEC3", 5126, 3, {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
  int const indices = b.accessor<std::uint16_t>("SCALAR", 5123, 1, {0, 1, 2, 0, 2, 3});
  b.primitive() = {{"attributes", {{"POSITION", positions}}}, {"indices", indices}};
  return b;
}

Builder mapped_square() {
  Builder b = square();
  b.primitive()["attributes"]["TEXCOORD_0"] = b.accessor<float>("VEC2", 5126, 2, {0, 0, 1, 0, 1, 1, 0, 1});
  EncodedImage const png = encode_image({1, 1, 3, ColourSpace::srgb, {9, 8, 7}}, {ImageCodec::png});
  int const view = b.view({reinterpret_cast<char const*>(png.bytes.data()), png.bytes.size()});
  b.json["images"] = {{{"bufferView", view}, {"mimeType", "image/png"}}};
  b.json["textures"] = {{{"source", 0}}};
  b.json["materials"] = {{{"name", "m"}, {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
  b.primitive()["material"] = 0;
  return b;
}

Blob blob(std::string const& text) {
  auto const bytes = std::as_bytes(std::span(text));
  return own({bytes.begin(), bytes.end()});
}

std::optional<Blob> nothing(std::string_view) { return std::nullopt; }

SourceModel read(std::string const& file, ReadOptions const& options = {}) {
  return read_gltf(blob(file), nothing, options);
}
SourceModel read(Builder b, ReadOptions const& options = {}) { return read(b.text(), options); }

Error failure(std::string const& file, ReadOptions const& options = {}) {
  try {
    read(file, options);
  } catch (Error const& error) {
    return error;
  }
  return {ErrorKind::broken, "no failure", ""};
}
std::string reason(Builder b) { return failure(b.text()).what(); }

// ---- containers -----------------------------------------------------------------------------------------------------

TEST(ReadGltf, TextAndBinaryGiveTheSameModel) {
  SourceModel const a = read(square().text()), b = read(square().glb());
  EXPECT_EQ(a.mesh.positions, b.mesh.positions);
  EXPECT_THAT(b.mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
}

TEST(ReadGltf, EveryCutOfABinaryFileIsRefused) {
  std::string const whole = square().glb();
  for (std::size_t size = 0; size < whole.size(); size += 7)
    EXPECT_NE(failure(whole.substr(0, size)).kind(), ErrorKind::broken) << size;
}

TEST(ReadGltf, EveryCutOfATextFileIsRefused) {
  std::string const whole = square().text();
  for (std::size_t size = 0; size < whole.size(); size += 7)
    EXPECT_NE(failure(whole.substr(0, size)).kind(), ErrorKind::broken) << size;
}

TEST(ReadGltf, ADamagedDocumentIsNotQuotedAtLength) {
  EXPECT_LT(std::strlen(failure("{\"a\": \"" + std::string(100000, 'x')).what()), 200u);
}

TEST(ReadGltf, AMissingBufferFileIsNamed) {
  Builder b = square();
  b.text();
  b.json["buffers"][0]["uri"] = "gone.bin";
  EXPECT_THAT(failure(b.json.dump()).what(), HasSubstr("gone.bin"));
}

TEST(ReadGltf, UnknownRequiredExtensionsAreNamed) {
  Builder b = square();
  b.json["extensionsRequired"] = {"ACME_cubes"};
  Error const error = failure(b.text());
  EXPECT_EQ(error.kind(), ErrorKind::unsupported);
  EXPECT_THAT(error.what(), HasSubstr("ACME_cubes"));
}

TEST(ReadGltf, AnOlderVersionIsUnsupported) {
  Builder b = square();
  b.json["asset"]["version"] = "1.0";
  EXPECT_EQ(failure(b.text()).kind(), ErrorKind::unsupported);
}

// ---- every number is checked ----------------------------------------------------------------------------------------

TEST(ReadGltf, AnIndexPastTheVerticesIsRefused) {
  Builder b = square();
  b.primitive()["indices"] = b.accessor<std::uint16_t>("SCALAR", 5123, 1, {0, 1, 4});
  EXPECT_THAT(reason(b), HasSubstr("vertex 4 of 4"));
}

TEST(ReadGltf, AnAccessorPastItsViewIsRefused) {
  Builder b = square();
  b.json["accessors"][0]["count"] = 5;
  EXPECT_THAT(reason(b), HasSubstr("5 elements"));
  b.json["accessors"][0]["count"] = 18446744073709551615u;
  EXPECT_THAT(reason(b), HasSubstr("18446744073709551615 elements"));
}

TEST(ReadGltf, AViewPastItsBufferIsRefused) {
  Builder b = square();
  b.json["bufferViews"][0]["byteOffset"] = 1000;
  EXPECT_THAT(reason(b), HasSubstr("48 bytes from 1000"));
}

TEST(ReadGltf, NumbersThatPointNowhereAreRefused) {
  for (char const* path :
       {"/nodes/0/mesh", "/meshes/0/primitives/0/attributes/POSITION", "/meshes/0/primitives/0/indices",
        "/accessors/0/bufferView", "/bufferViews/0/buffer", "/meshes/0/primitives/0/material", "/scenes/0/nodes/0"}) {
    Builder b = square();
    b.json[Doc::json_pointer(path)] = 99;
    EXPECT_THAT(reason(b), HasSubstr("[99] of")) << path;
  }
}

TEST(ReadGltf, ValuesOfTheWrongTypeAreRefused) {
  for (char const* path : {"/nodes", "/scenes/0/nodes", "/meshes/0/primitives", "/accessors/0/count",
                           "/accessors/0/type", "/bufferViews/0/byteLength"}) {
    Builder b = square();
    b.json[Doc::json_pointer(path)] = {{"odd", true}};
    EXPECT_EQ(failure(b.text()).kind(), ErrorKind::invalid_input) << path;
  }
}

TEST(ReadGltf, AttributesOfDifferentCountsAreRefused) {
  Builder b = square();
  b.primitive()["attributes"]["NORMAL"] = b.accessor<float>("VEC3", 5126, 3, {0, 0, 1});
  EXPECT_THAT(reason(b), HasSubstr("1 elements of NORMAL for 4 vertices"));
}

TEST(ReadGltf, NodesInACycleAreRefused) {
  Builder b = square();
  b.json["nodes"] = {{{"children", {1}}}, {{"children", {0}}, {"mesh", 0}}};
  EXPECT_THAT(reason(b), HasSubstr("reached twice"));
}

TEST(ReadGltf, NodesNestOnlySoDeep) {
  Builder b = square();
  b.json["nodes"] = Doc::array();
  for (int i = 0; i < 100; ++i) b.json["nodes"].push_back({{"children", {i + 1}}});
  b.json["nodes"].push_back({{"mesh", 0}});
  EXPECT_EQ(failure(b.text()).kind(), ErrorKind::limit_exceeded);
}

TEST(ReadGltf, InstancesCountAgainstTheLimit) {
  Builder b = square();
  b.json["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}}};
  b.json["scenes"][0]["nodes"] = {0, 1};
  ReadOptions options;
  options.limits.triangles = 3;
  EXPECT_EQ(failure(b.text(), options).kind(), ErrorKind::limit_exceeded);
}

// ---- geometry -------------------------------------------------------------------------------------------------------

TEST(ReadGltf, StripsAndFansBecomeTriangles) {
  Builder b = square();
  b.primitive().erase("indices");
  b.primitive()["mode"] = 5;
  EXPECT_THAT(read(b).mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{2, 1, 3}));
  b.primitive()["mode"] = 6;
  EXPECT_THAT(read(b).mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
}

TEST(ReadGltf, PointsAndLinesAreLeftOutAndCounted) {
  Builder b = square();
  b.json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}, {"mode", 0}});
  EXPECT_THAT(read(b).notes, Contains(HasSubstr("1 primitives of points or lines")));
  b.primitive()["mode"] = 1;
  EXPECT_THAT(reason(b), HasSubstr("no faces"));
}

TEST(ReadGltf, NodesStandInWorldSpace) {
  Builder b = square();
  b.json["nodes"] = {{{"children", {1}}, {"translation", {10, 0, 0}}},
                     {{"mesh", 0}, {"rotation", {0, 0, std::sqrt(0.5), std::sqrt(0.5)}}, {"scale", {2, 2, 2}}}};
  V3f const corner = read(b).mesh.positions[1];  // (1, 0, 0), doubled, turned by 90 degrees about z, shifted
  EXPECT_NEAR(corner.x, 10, 1e-5);
  EXPECT_NEAR(corner.y, 2, 1e-5);
}

TEST(ReadGltf, AMatrixIsReadByColumns) {
  Builder b = square();
  b.json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1};
  EXPECT_EQ(read(b).mesh.positions[0], V3f(5, 6, 7));
}

TEST(ReadGltf, MirroredNodesKeepTheirFacesOutside) {
  Builder b = square();
  b.json["nodes"][0]["scale"] = {-1, 1, 1};
  SourceModel const model = read(b);
  Triangle const t = model.mesh.triangles[0];
  std::vector<V3f> const& p = model.mesh.positions;
  EXPECT_GT((p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).z, 0);
}

TEST(ReadGltf, NormalsStayUprightUnderUnevenScale) {
  Builder b = square();
  b.primitive()["attributes"]["NORMAL"] = b.accessor<float>("VEC3", 5126, 3, {1, 1, 0, 1, 1, 0, 1, 1, 0, 1, 1, 0});
  b.json["nodes"][0]["scale"] = {2, 1, 1};
  V3f const normal = read(b).normals[0];
  EXPECT_NEAR(normal.x / normal.y, 0.5, 1e-5);
  EXPECT_NEAR(normal.length(), 1, 1e-5);
}

TEST(ReadGltf, QuantisedPositionsNeedTheExtension) {
  Builder b = square();
  b.primitive()["attributes"]["POSITION"] =
      b.accessor<std::int16_t>("VEC3", 5122, 3, {0, 0, 0, 9, 0, 0, 9, 9, 0, 0, 9, 0});
  EXPECT_THAT(reason(b), HasSubstr("componentType 5122"));
  b.json["extensionsUsed"] = {"KHR_mesh_quantization"};
  EXPECT_EQ(read(b).mesh.positions[1], V3f(9, 0, 0));
  b.json["accessors"].back()["normalized"] = true;
  EXPECT_FLOAT_EQ(read(b).mesh.positions[1].x, 9 / 32767.0f);
}

TEST(ReadGltf, SparseAccessorsReplaceElements) {
  Builder b = square();
  int const places = b.view(raw(std::vector<std::uint8_t>{3})), values = b.view(raw(std::vector<float>{7, 8, 9}));
  b.json["accessors"][0]["sparse"] = {{"count", 1},
                                      {"indices", {{"bufferView", places}, {"componentType", 5121}}},
                                      {"values", {{"bufferView", values}}}};
  SourceModel const model = read(b);
  EXPECT_EQ(model.mesh.positions[3], V3f(7, 8, 9));
  EXPECT_EQ(model.mesh.positions[2], V3f(1, 1, 0));
}

TEST(ReadGltf, AccessorsWithoutAViewAreZero) {
  Builder b = square();
  b.json["accessors"].push_back({{"componentType", 5126}, {"count", 4}, {"type", "VEC3"}});
  b.primitive()["attributes"]["NORMAL"] = b.json["accessors"].size() - 1;
  EXPECT_THAT(read(b).normals, ElementsAre(V3f(0), V3f(0), V3f(0), V3f(0)));
  b.json["accessors"].back()["count"] = 2'000'000'000;
  EXPECT_THAT(reason(b), HasSubstr("2000000000 elements has no bytes"));
}

TEST(ReadGltf, PartsWithoutAnAttributeAreFilledUp) {
  Builder b = square();
  Doc second = {
      {"attributes",
       {{"POSITION", 0}, {"NORMAL", b.accessor<float>("VEC3", 5126, 3, {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1})}}},
      {"indices", 1}};
  second["attributes"]["COLOR_0"] =
      b.accessor<std::uint8_t>("VEC4", 5121, 4, {255, 0, 0, 255, 255, 0, 0, 255, 255, 0, 0, 255, 255, 0, 0, 128});
  b.json["meshes"][0]["primitives"].push_back(second);
  SourceModel const model = read(b);
  EXPECT_EQ(model.colours[0], (Rgba16{65535, 65535, 65535, 65535}));
  EXPECT_EQ(model.colours[7], (Rgba16{65535, 0, 0, 32896}));
  EXPECT_EQ(model.normals[0], V3f(0, 0, 0));  // for `clean` to replace
  EXPECT_EQ(model.normals[4], V3f(0, 0, 1));
  EXPECT_EQ(model.mesh.triangles[2], (Triangle{4, 5, 6}));
}

TEST(ReadGltf, VerticesThatAPartDoesNotUseAreDropped) {
  Builder b = square();
  Doc second = b.primitive();
  b.primitive()["indices"] = b.accessor<std::uint16_t>("SCALAR", 5123, 1, {0, 1, 2});
  second["indices"] = b.accessor<std::uint16_t>("SCALAR", 5123, 1, {3, 0, 2});
  b.json["meshes"][0]["primitives"].push_back(second);
  SourceModel const model = read(b);
  EXPECT_THAT(model.mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{5, 3, 4}));
  EXPECT_EQ(model.mesh.positions[5], V3f(0, 1, 0));
}

TEST(ReadGltf, SkinnedMeshesStandWhereTheirJointsDo) {
  Builder b = square();
  b.primitive()["attributes"]["JOINTS_0"] =
      b.accessor<std::uint8_t>("VEC4", 5121, 4, {0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
  b.primitive()["attributes"]["WEIGHTS_0"] =
      b.accessor<float>("VEC4", 5126, 4, {1, 0, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
  b.json["skins"] = {{{"joints", {1, 2}}}};
  b.json["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"translation", {100, 0, 0}}},
                     {{"translation", {0, 0, 4}}},
                     {{"translation", {0, 0, 8}}}};
  b.json["scenes"][0]["nodes"] = {0, 1, 2};
  SourceModel const model = read(b);
  EXPECT_EQ(model.mesh.positions[0], V3f(0, 0, 4));
  EXPECT_EQ(model.mesh.positions[1], V3f(1, 0, 6));  // the mean of both joints, whose weights are brought to 1
}

TEST(ReadGltf, MorphTargetsFollowTheMeshesWeights) {
  Builder b = square();
  b.primitive()["targets"] = {{{"POSITION", b.accessor<float>("VEC3", 5126, 3, {0, 0, 2, 0, 0, 2, 0, 0, 2, 0, 0, 2})}}};
  EXPECT_EQ(read(b).mesh.positions[0].z, 0);
  b.json["meshes"][0]["weights"] = {0.5};
  EXPECT_EQ(read(b).mesh.positions[0].z, 1);
}

TEST(ReadGltf, InstancingRepeatsTheMesh) {
  Builder b = square();
  int const places = b.accessor<float>("VEC3", 5126, 3, {0, 0, 1, 0, 0, 2, 0, 0, 3});
  b.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = places;
  SourceModel const model = read(b);
  ASSERT_THAT(model.mesh.triangles, SizeIs(6));
  EXPECT_EQ(model.mesh.positions[8].z, 3);
}

// ---- compression ----------------------------------------------------------------------------------------------------

Builder draco_square() {
  VertexMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  DracoMesh const draco = encode_draco(mesh, {{0, 0, 0}, 1, 12, 10, 0});
  Builder b = square();
  b.primitive()["attributes"]["TEXCOORD_0"] = 0;
  for (Doc& accessor : b.json["accessors"]) accessor.erase("bufferView");
  int const view = b.view({reinterpret_cast<char const*>(draco.bytes.data()), draco.bytes.size()});
  b.primitive()["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", view}, {"attributes", {{"POSITION", draco.position_id}, {"TEXCOORD_0", draco.uv_id}}}};
  return b;
}

TEST(ReadGltf, DracoIsDecoded) {
  SourceModel const model = read(draco_square());
  EXPECT_THAT(model.mesh.triangles, SizeIs(2));
  EXPECT_THAT(model.mesh.positions,
              testing::UnorderedElementsAre(V3f(0, 0, 0), V3f(1, 0, 0), V3f(1, 1, 0), V3f(0, 1, 0)));
  EXPECT_THAT(model.uvs, SizeIs(4));
}

TEST(ReadGltf, DamagedDracoIsRefused) {
  Builder b = draco_square();
  std::size_t const start = b.json["bufferViews"].back()["byteOffset"].get<std::size_t>();
  for (std::size_t size = 0; size + 4 < b.bytes.size() - start; size += 3) {
    b.json["bufferViews"].back()["byteLength"] = size;
    EXPECT_EQ(failure(b.text()).kind(), ErrorKind::invalid_input) << size;
  }
}

TEST(ReadGltf, DracoCountsBeyondItsBytesAreRefusedBeforeDecoding) {
  Builder b = draco_square();
  std::size_t const start = b.json["bufferViews"].back()["byteOffset"].get<std::size_t>();
  b.bytes.replace(start + 12, 10,
                  "\xFF\xFF\xFF\xFF\x07\xFF\xFF\xFF\xFF\x07");  // vertices and faces as varints of 2^31 - 1
  EXPECT_NE(failure(b.text()).kind(), ErrorKind::broken);
}

TEST(ReadGltf, MeshoptIsDecodedWithItsFallbackBufferAbsent) {
  std::vector<float> const positions{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  std::vector<unsigned char> packed(meshopt_encodeVertexBufferBound(4, 12));
  packed.resize(meshopt_encodeVertexBuffer(packed.data(), packed.size(), positions.data(), 4, 12));
  Builder b = square();
  int const view = b.view(raw(packed));
  Doc& compressed = b.json["bufferViews"][static_cast<std::size_t>(view)];
  Doc fallback = {{"buffer", 1}, {"byteLength", 48}};
  fallback["extensions"]["EXT_meshopt_compression"] = compressed;
  fallback["extensions"]["EXT_meshopt_compression"].update({{"byteStride", 12}, {"count", 4}, {"mode", "ATTRIBUTES"}});
  compressed = fallback;
  b.json["accessors"][0]["bufferView"] = view;
  EXPECT_EQ(read(b).mesh.positions[2], V3f(1, 1, 0));

  Doc& stream = b.json["bufferViews"][static_cast<std::size_t>(view)]["extensions"]["EXT_meshopt_compression"];
  stream["byteLength"] = 20;
  EXPECT_THAT(reason(b), HasSubstr("damaged meshopt"));
  stream["count"] = 1000000000;
  EXPECT_EQ(failure(b.text()).kind(), ErrorKind::invalid_input);
  stream["mode"] = "CUBES";
  EXPECT_THAT(reason(b), HasSubstr("CUBES"));
}

// ---- materials ------------------------------------------------------------------------------------------------------

TEST(ReadGltf, WithoutAMaterialThereIsNoColour) { EXPECT_FALSE(has_colour(read(square()))); }

TEST(ReadGltf, AWhiteMaterialIsNoColourAndATintIs) {
  Builder b = square();
  b.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 1}}}}}};
  b.primitive()["material"] = 0;
  EXPECT_FALSE(has_colour(read(b)));
  b.json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {0.5, 1, 1, 0.25};
  SourceModel const model = read(b);
  EXPECT_TRUE(has_colour(model));
  EXPECT_EQ(model.materials[0].base_colour, (Rgba{0.5f, 1, 1, 0.25f}));
}

TEST(ReadGltf, EmbeddedTexturesAreDecoded) {
  SourceModel const model = read(mapped_square());
  ASSERT_EQ(model.materials[0].colour_map.image, 0);
  EXPECT_THAT(model.images[0].texels, ElementsAre(9, 8, 7));
  EXPECT_EQ(model.images[0].space, ColourSpace::srgb);
}

TEST(ReadGltf, MissingTexturesAreNotedAndTheMeshRead) {
  Builder b = mapped_square();
  b.json["images"][0] = {{"uri", "gone.png"}};
  SourceModel const model = read(b);
  EXPECT_EQ(model.materials[0].colour_map.image, -1);
  EXPECT_THAT(model.notes, Contains(HasSubstr("gone.png")));
}

TEST(ReadGltf, ABetterCodecsImageIsTakenWhereTheFileOffersOne) {
  for (auto const& [name, codec] :
       {std::pair{"EXT_texture_webp", ImageCodec::webp}, {"EXT_texture_avif", ImageCodec::avif}}) {
    Builder b = mapped_square();
    EncodedImage const better = encode_image({2, 2, 3, ColourSpace::srgb, std::vector<std::uint8_t>(12, 50)}, {codec});
    int const view = b.view({reinterpret_cast<char const*>(better.bytes.data()), better.bytes.size()});
    b.json["images"].push_back({{"bufferView", view}, {"mimeType", better.mime}});
    b.json["textures"][0]["extensions"][name] = {{"source", 1}};
    EXPECT_EQ(read(b).images.at(0).width, 2) << name;
    b.json["textures"][0].erase("source");
    b.json["extensionsRequired"] = {name};
    EXPECT_EQ(read(b).images.at(0).width, 2) << name;
  }
}

TEST(ReadGltf, SamplersSayHowTexturesRepeat) {
  Builder b = mapped_square();
  b.json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}}};
  b.json["textures"][0]["sampler"] = 0;
  TextureUse const use = read(b).materials[0].colour_map;
  EXPECT_EQ(use.wrap_u, Wrap::clamp);
  EXPECT_EQ(use.wrap_v, Wrap::mirror);
  EXPECT_TRUE(use.mipmapped);
  b.json["samplers"][0]["minFilter"] = 9729;
  EXPECT_FALSE(read(b).materials[0].colour_map.mipmapped);
}

TEST(ReadGltf, SamplersSayWhatIsReadBetweenTexels) {
  Builder b = mapped_square();
  b.json["textures"][0]["sampler"] = 0;
  b.json["samplers"][0] = {{"magFilter", 9729}, {"minFilter", 9987}};
  EXPECT_EQ(read(b).materials[0].colour_map.magnified, Filter::linear);
  EXPECT_EQ(read(b).materials[0].colour_map.minified, Filter::linear);
  b.json["samplers"][0] = {{"magFilter", 9728}};
  EXPECT_EQ(read(b).materials[0].colour_map.magnified, Filter::nearest);
  EXPECT_EQ(read(b).materials[0].colour_map.minified, Filter::linear);
  for (int nearest : {9728, 9984, 9986}) {
    b.json["samplers"][0] = {{"minFilter", nearest}};
    EXPECT_EQ(read(b).materials[0].colour_map.magnified, Filter::linear);
    EXPECT_EQ(read(b).materials[0].colour_map.minified, Filter::nearest);
  }
}

TEST(ReadGltf, TextureTransformsScaleThenTurnThenShift) {
  Builder b = mapped_square();
  Doc& info = b.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
  info["extensions"]["KHR_texture_transform"] = {
      {"offset", {0.25, 0}}, {"scale", {2, 1}}, {"rotation", std::acos(-1.0) / 2}};
  std::array<float, 6> const m = read(b).materials[0].colour_map.matrix;
  // (1, 0) is scaled to (2, 0), turned anticlockwise as seen with v downwards to (0, -2), shifted to (0.25, -2).
  EXPECT_NEAR(m[0] + m[2], 0.25, 1e-6);
  EXPECT_NEAR(m[3] + m[5], -2, 1e-6);
}

TEST(ReadGltf, TexturesChooseTheirSetOfCoordinates) {
  Builder b = mapped_square();
  b.primitive()["attributes"]["TEXCOORD_1"] = b.accessor<std::uint16_t>("VEC2", 5123, 2, {65535, 0, 0, 0, 0, 0, 0, 0});
  b.json["accessors"].back()["normalized"] = true;
  Doc& info = b.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
  info["texCoord"] = 1;
  EXPECT_EQ(read(b).uvs[0], V2f(1, 0));
  info["extensions"]["KHR_texture_transform"]["texCoord"] = 0;
  EXPECT_EQ(read(b).uvs[0], V2f(0, 0));
}

TEST(ReadGltf, ANormalMapOnOtherCoordinatesIsLeftOutWithANote) {
  Builder b = mapped_square();
  b.json["materials"][0]["normalTexture"] = {{"index", 0}, {"scale", 0.5}};
  SourceModel const model = read(b);
  EXPECT_EQ(model.images[static_cast<std::size_t>(model.materials[0].normal_map.image)].space, ColourSpace::linear);
  EXPECT_EQ(model.materials[0].normal_scale, 0.5f);
  b.json["materials"][0]["normalTexture"]["texCoord"] = 1;
  EXPECT_EQ(read(b).materials[0].normal_map.image, -1);
  EXPECT_THAT(read(b).notes, Contains(HasSubstr("normal map")));
}

TEST(ReadGltf, OcclusionMapsAreReadWhereAsked) {
  Builder b = mapped_square();
  b.json["materials"][0]["occlusionTexture"] = {{"index", 0}, {"strength", 0.5}};
  EXPECT_EQ(read(b).materials[0].occlusion_map.image, -1);
  ReadOptions options;
  options.occlusion_maps = true;
  SourceModel const model = read(b, options);
  EXPECT_EQ(model.images[static_cast<std::size_t>(model.materials[0].occlusion_map.image)].space, ColourSpace::linear);
  EXPECT_EQ(model.materials[0].occlusion_strength, 0.5f);
  b.json["materials"][0]["occlusionTexture"]["texCoord"] = 1;
  EXPECT_EQ(read(b, options).materials[0].occlusion_map.image, -1);
  EXPECT_THAT(read(b, options).notes, Contains(HasSubstr("occlusion map")));
}

TEST(ReadGltf, MaterialsKeepAlphaSidesAndLight) {
  Builder b = mapped_square();
  b.json["materials"][0].update({{"alphaMode", "MASK"}, {"alphaCutoff", 0.25}, {"doubleSided", true}});
  b.json["materials"][0]["extensions"]["KHR_materials_unlit"] = Doc::object();
  SourceModel const model = read(b);
  Material const& m = model.materials[0];
  EXPECT_EQ(m.alpha, AlphaMode::mask);
  EXPECT_EQ(m.alpha_cutoff, 0.25f);
  EXPECT_TRUE(m.double_sided && m.unlit);
}

TEST(ReadGltf, MaterialsEmit) {
  Builder b = mapped_square();
  Doc& material = b.json["materials"][0];
  material["emissiveFactor"] = {0.25, 0, 0.5};
  material["emissiveTexture"] = {{"index", 0}};
  material["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", 2}};
  Material const bright = read(b).materials[0];
  EXPECT_TRUE(emits(bright));
  EXPECT_EQ(bright.emission, V3f(0.5f, 0, 1));
  EXPECT_EQ(bright.emission_map.image, bright.colour_map.image);
  EXPECT_TRUE(bright.coloured);

  material["emissiveTexture"]["texCoord"] = 1;
  EXPECT_FALSE(emits(read(b).materials[0]));
  EXPECT_THAT(read(b).notes, Contains(HasSubstr("emission")));
}

TEST(ReadGltf, WhatOnlyEmitsIsUnlit) {
  Builder b = mapped_square();
  Doc& material = b.json["materials"][0];
  material["emissiveFactor"] = {1, 1, 1};
  material["emissiveTexture"] = {{"index", 0}};
  material["pbrMetallicRoughness"] = {{"baseColorFactor", {0, 0, 0, 1}}};
  b.primitive()["attributes"]["COLOR_0"] =
      b.accessor<std::uint8_t>("VEC3", 5121, 3, {255, 0, 0, 255, 0, 0, 255, 0, 0, 255, 0, 0});
  SourceModel const model = read(b);
  Material const& read_as = model.materials[0];
  EXPECT_TRUE(read_as.unlit);
  EXPECT_THAT(model.colours, IsEmpty());  // they reflect
  EXPECT_FALSE(emits(read_as));
  EXPECT_EQ(read_as.base_colour, (Rgba{1, 1, 1, 1}));
  EXPECT_GE(read_as.colour_map.image, 0);
}

TEST(ReadGltf, TexturesWithoutCoordinatesAreLeftOut) {
  Builder b = mapped_square();
  b.primitive()["attributes"].erase("TEXCOORD_0");
  SourceModel const model = read(b);
  EXPECT_THAT(model.images, IsEmpty());
  EXPECT_EQ(model.materials[0].colour_map.image, -1);
}

}  // namespace
