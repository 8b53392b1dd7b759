// SPDX-License-Identifier: Apache-2.0
#include "io/write_glb.h"

#include "io/mesh_codec.h"
#include "io/read_model.h"
#include "stages/error.h"
#include "tests/support/delivered.h"
#include "tests/support/meshes.h"

#include <gmock/gmock.h>
#include <meshoptimizer.h>
#include <nlohmann/json.hpp>

#include <cstring>
#include <string>
#include <vector>

namespace vitrine::io {
namespace {

using Json = nlohmann::json;
using Bytes = std::vector<std::byte>;

constexpr Profile kProfiles[] = {Profile::web, Profile::plain, Profile::meshopt, Profile::core};

struct Glb {
  Json json;
  Bytes bin;
};

std::uint32_t u32_at(Bytes const& bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

/// Cuts a file into its two chunks, and checks each length that it states.
Glb parse(Bytes const& file) {
  EXPECT_EQ(std::string(reinterpret_cast<char const*>(file.data()), 4), "glTF");
  EXPECT_EQ(u32_at(file, 4), 2u);
  EXPECT_EQ(u32_at(file, 8), file.size());
  std::size_t const json_size = u32_at(file, 12), bin_at = 20 + json_size + 8;
  EXPECT_EQ(json_size % 4, 0u);
  EXPECT_EQ(bin_at + u32_at(file, bin_at - 8), file.size());
  Glb glb{Json::parse(reinterpret_cast<char const*>(file.data()) + 20,
                      reinterpret_cast<char const*>(file.data()) + 20 + json_size),
          Bytes(file.begin() + static_cast<std::ptrdiff_t>(bin_at), file.end())};
  EXPECT_EQ((glb.json["buffers"][0]["byteLength"].get<std::size_t>() + 3) / 4 * 4, glb.bin.size());
  return glb;
}

Json json_of(BakedModel const& model, EncodeOptions const& options = {}, std::string_view title = "") {
  return parse(encode(model, title, options).glb).json;
}

Image image(int channels, ColourSpace space = ColourSpace::srgb) {
  Image result{16, 16, channels, space, {}};
  for (int i = 0; i < 256 * channels; ++i) result.texels.push_back(static_cast<std::uint8_t>(i * 7));
  return result;
}

BakedModel bare_cube() {
  BakedModel model;
  model.mesh = test::cube();
  model.grid = {{-1, -1, -1}, 2, 11, 11, 8};
  return model;
}

BakedModel with_all_maps() {
  BakedModel model = test::random_model(1);
  model.colour = image(3);
  model.normal = image(3, ColourSpace::linear);
  model.occlusion = image(1, ColourSpace::linear);
  return model;
}

/// The bytes of buffer view `v`, decoded where they are coded by meshopt.
Bytes view(Glb const& glb, std::size_t v) {
  Json const& view = glb.json["bufferViews"][v];
  bool const coded = view.contains("extensions");
  Json const& source = coded ? view["extensions"]["EXT_meshopt_compression"] : view;
  std::size_t const offset = source.value("byteOffset", std::size_t{0}), length = source["byteLength"];
  auto const* from = reinterpret_cast<unsigned char const*>(glb.bin.data()) + offset;
  if (!coded)
    return Bytes(glb.bin.begin() + static_cast<std::ptrdiff_t>(offset),
                 glb.bin.begin() + static_cast<std::ptrdiff_t>(offset + length));
  std::size_t const count = source["count"], stride = source["byteStride"];
  Bytes bytes(count * stride);
  EXPECT_EQ(bytes.size(), view["byteLength"].get<std::size_t>());
  bool const vertices = source["mode"] == "ATTRIBUTES";
  EXPECT_EQ(vertices ? meshopt_decodeVertexBuffer(bytes.data(), count, stride, from, length)
                     : meshopt_decodeIndexBuffer(bytes.data(), count, stride, from, length),
            0);
  EXPECT_EQ(from[0], vertices ? 0xA0 : 0xE1);  // the versions that the extension knows
  return bytes;
}

template <class Integer>
Integer at(Bytes const& bytes, std::size_t offset) {
  Integer value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

/// What a client makes of quantised buffers: vertices in view 0, indices in view 1, scale and translation in the node.
VertexMesh dequantise(Glb const& glb) {
  Json const& node = glb.json["nodes"][0];
  Json const& attributes = glb.json["meshes"][0]["primitives"][0]["attributes"];
  Bytes const vertices = view(glb, 0), indices = view(glb, 1);
  std::size_t const stride = glb.json["bufferViews"][0]["byteStride"];
  auto offset = [&](char const* name) {
    return glb.json["accessors"][attributes[name].get<std::size_t>()].value("byteOffset", std::size_t{0});
  };
  VertexMesh mesh;
  for (std::size_t v = 0; v < vertices.size(); v += stride) {
    V3f p;
    for (unsigned k = 0; k < 3; ++k)
      p[k] = float(node["translation"][k].get<double>() +
                   node["scale"][k].get<double>() * at<std::uint16_t>(vertices, v + 2 * k));
    mesh.positions.push_back(p);
    if (attributes.contains("NORMAL")) {
      std::size_t const n = v + offset("NORMAL");
      mesh.normals.push_back(
          V3f(at<std::int8_t>(vertices, n), at<std::int8_t>(vertices, n + 1), at<std::int8_t>(vertices, n + 2)) /
          127.0f);
    }
    if (attributes.contains("TANGENT")) {
      Imath::V4f tangent;
      for (int k = 0; k < 4; ++k)
        tangent[k] = at<std::int8_t>(vertices, v + offset("TANGENT") + std::size_t(k)) / 127.0f;
      mesh.tangents.push_back(tangent);
    }
    if (attributes.contains("COLOR_0")) {
      V3f colour;
      for (unsigned k = 0; k < 3; ++k) colour[k] = at<std::uint8_t>(vertices, v + offset("COLOR_0") + k) / 255.0f;
      mesh.colours.push_back(colour);
    }
    if (attributes.contains("TEXCOORD_0")) {
      std::size_t const t = v + offset("TEXCOORD_0");
      mesh.uvs.push_back(V2f(at<std::uint16_t>(vertices, t), at<std::uint16_t>(vertices, t + 2)) / 65535.0f);
    }
  }
  std::size_t const size = mesh.positions.size() > 65535 ? 4 : 2;
  for (std::size_t i = 0; i < indices.size(); i += 3 * size) {
    Triangle t;
    for (std::size_t c = 0; c < 3; ++c)
      t[c] = size == 4 ? at<std::uint32_t>(indices, i + 4 * c) : at<std::uint16_t>(indices, i + 2 * c);
    mesh.triangles.push_back(t);
  }
  return mesh;
}

/// Moves what was decoded to 16 bits back to the 11 bits that it came from, when it is within 16 bits' half step.
void snap_to(Grid const& grid, VertexMesh& mesh) {
  float const step = grid.range / float((1 << grid.position_bits) - 1), uv_step = 1 / float((1 << grid.uv_bits) - 1);
  float const colour_steps = float((1 << grid.colour_bits) - 1);
  for (V3f& p : mesh.positions)
    for (unsigned k = 0; k < 3; ++k) {
      float const exact = grid.origin[k] + std::round((p[k] - grid.origin[k]) / step) * step;
      EXPECT_NEAR(p[k], exact, 1e-6f);
      p[k] = exact;
    }
  for (V3f& colour : mesh.colours)
    for (unsigned k = 0; k < 3; ++k) {
      float const exact = std::round(colour[k] * colour_steps) * (1 / colour_steps);
      EXPECT_NEAR(colour[k], exact, 0.51f / 255);
      colour[k] = exact;
    }
  for (V2f& uv : mesh.uvs)
    for (unsigned k = 0; k < 2; ++k) {
      float const exact = std::round(uv[k] / uv_step) * uv_step;
      EXPECT_NEAR(uv[k], exact, 0.51f / 65535);
      uv[k] = exact;
    }
}

TEST(WriteGlb, EachMapInTheCodecAskedFor) {
  EncodeOptions options;
  options.colour_codec = MapCodec::jpeg;
  options.normal_codec = MapCodec::png;
  EncodedThumbnail const t = encode(with_all_maps(), "", options);
  Json const json = parse(t.glb).json;
  EXPECT_EQ(json["images"][0]["mimeType"], "image/jpeg");
  EXPECT_EQ(json["images"][1]["mimeType"], "image/png");
  EXPECT_EQ(json["images"][2]["mimeType"], "image/jpeg");
}

TEST(WriteGlb, PartsAddUpInAllProfiles) {
  for (Profile profile : kProfiles)
    for (BakedModel const& model : {bare_cube(), with_all_maps()}) {
      EncodedThumbnail const t = encode(model, "Lucy", {profile});
      EXPECT_EQ(t.geometry + t.colour + t.normal + t.occlusion + t.other, t.glb.size());
      EXPECT_GT(t.geometry, 0u);
      EXPECT_EQ(t.colour > 0, model.colour.has_value());
      EXPECT_EQ(t.normal > 0, model.normal.has_value());
      EXPECT_EQ(t.occlusion > 0, model.occlusion.has_value());
      EXPECT_EQ(t.triangles, model.mesh.triangles.size());
    }
}

TEST(WriteGlb, TheSameModelGivesTheSameBytes) {
  for (Profile profile : kProfiles)
    EXPECT_EQ(encode(with_all_maps(), "", {profile}).glb, encode(with_all_maps(), "", {profile}).glb);
}

TEST(WriteGlb, SpendsFewBytesOnAnUncolouredModel) { EXPECT_LT(encode(bare_cube(), "").other, 700u); }

TEST(WriteGlb, SaysWhatAClientMustKnow) {
  using testing::UnorderedElementsAre;
  auto needs = [](Profile profile) {
    return json_of(with_all_maps(), {profile})["extensionsRequired"].get<std::vector<std::string>>();
  };
  EXPECT_THAT(needs(Profile::web), UnorderedElementsAre("KHR_draco_mesh_compression", "EXT_texture_webp"));
  EXPECT_THAT(needs(Profile::plain), UnorderedElementsAre("KHR_mesh_quantization"));
  EXPECT_THAT(needs(Profile::meshopt),
              UnorderedElementsAre("EXT_meshopt_compression", "KHR_mesh_quantization", "EXT_texture_webp"));
}

TEST(WriteGlb, CoreNeedsNoExtension) {
  Json const json = json_of(with_all_maps(), {Profile::core});
  EXPECT_FALSE(json.contains("extensionsUsed"));
  EXPECT_FALSE(json["nodes"][0].contains("scale"));
}

TEST(WriteGlb, DracoDecodesToTheGridAndLiesInTheStatedBounds) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    BakedModel const model = test::random_model(seed);
    EncodedThumbnail const thumbnail = encode(model, "");
    Glb const glb = parse(thumbnail.glb);
    VertexMesh const mesh = test::decode_draco(view(glb, 0));
    EXPECT_EQ(test::corners(mesh), test::corners(split_vertices(model)));
    EXPECT_EQ(mesh.positions.size(), thumbnail.vertices);
    EXPECT_EQ(glb.json["accessors"][0]["count"], thumbnail.vertices);
    Json const &low = glb.json["accessors"][0]["min"], &high = glb.json["accessors"][0]["max"];
    Box3f box;
    for (V3f const& p : mesh.positions) box.extendBy(p);
    for (unsigned k = 0; k < 3; ++k) {
      EXPECT_LE(low[k].get<double>(), box.min[k]);
      EXPECT_GE(high[k].get<double>(), box.max[k]);
      EXPECT_NEAR(low[k].get<double>(), box.min[k], 1e-3 * model.grid.range);
      EXPECT_NEAR(high[k].get<double>(), box.max[k], 1e-3 * model.grid.range);
    }
  }
}

TEST(WriteGlb, BuffersDequantiseToTheGrid) {
  for (Profile profile : {Profile::plain, Profile::meshopt})
    for (unsigned seed = 1; seed <= 5; ++seed) {
      SCOPED_TRACE(testing::Message() << "seed " << seed);
      BakedModel const model = test::random_model(seed);
      VertexMesh mesh = dequantise(parse(encode(model, "", {profile}).glb));
      for (std::size_t i = 0; i < mesh.normals.size(); ++i)
        EXPECT_GT(mesh.normals[i].normalized().dot(mesh.positions[i].normalized()), std::cos(0.01f));
      snap_to(model.grid, mesh);
      EXPECT_EQ(test::corners(mesh), test::corners(split_vertices(model)));
    }
}

TEST(WriteGlb, ColoursPerVertexComeBackInAllProfiles) {
  BakedModel const model = test::coloured_model(1);
  for (Profile profile : kProfiles) {
    Resolve const nothing = [](std::string_view) { return std::nullopt; };
    SourceModel const read = read_gltf(own(encode(model, "", {profile}).glb), nothing);
    VertexMesh mesh{read.mesh.positions, {}, {}, {}, {}, read.mesh.triangles};
    for (Rgba16 const& c : read.colours) {
      EXPECT_EQ(c[3], 65535);
      mesh.colours.push_back(V3f(c[0], c[1], c[2]) / 65535);
    }
    snap_to(model.grid, mesh);
    EXPECT_EQ(test::corners(mesh), test::corners(split_vertices(model)));
  }
}

TEST(WriteGlb, FlatColouredFilesHoldNothingElse) {
  for (Profile profile : kProfiles) {
    Json const json = json_of(test::coloured_model(1), {profile});
    Json const& attributes = json["meshes"][0]["primitives"][0]["attributes"];
    EXPECT_EQ(attributes.size(), 2u);
    Json const& accessor = json["accessors"][attributes["COLOR_0"].get<std::size_t>()];
    EXPECT_EQ(accessor["type"], "VEC3");
    EXPECT_EQ(accessor["componentType"], profile == Profile::web ? 5126 : 5121);
    EXPECT_EQ(accessor.value("normalized", false), profile != Profile::web);
    EXPECT_FALSE(json.contains("textures"));
  }
  EXPECT_LT(encode(test::coloured_model(1), "").other, 800u);
}

TEST(WriteGlb, PalettesAreStoredWithoutLossAndReadAsTheyAre) {
  BakedModel model = test::random_model(1);
  model.chart_tangents.clear();
  model.colour = image(3);
  model.palette = true;
  for (Profile profile : kProfiles) {
    EncodedThumbnail const thumbnail = encode(model, "", {profile});
    Json const json = parse(thumbnail.glb).json;
    EXPECT_EQ(json["samplers"], Json::parse(R"([{"minFilter":9729}])"));
    EXPECT_EQ(json["textures"], Json::parse(R"([{"source":0,"sampler":0}])"));
    Resolve const nothing = [](std::string_view) { return std::nullopt; };
    SourceModel const read = read_gltf(own(thumbnail.glb), nothing);
    EXPECT_FALSE(read.materials[0].colour_map.mipmapped);
    EXPECT_EQ(read.images[0].texels, model.colour->texels);
  }
}

TEST(WriteGlb, OurOwnReaderFindsTheSameMesh) {
  for (Profile profile : kProfiles) {
    BakedModel model = test::random_model(2);
    model.origin = {1e6, -2e6, 3e6};
    Resolve const nothing = [](std::string_view) { return std::nullopt; };
    SourceModel const read = read_gltf(own(encode(model, "", {profile}).glb), nothing);
    model.chart_tangents.clear();  // it reads none
    VertexMesh mesh{read.mesh.positions, {}, {}, read.uvs, {}, read.mesh.triangles};
    V3f const shift(read.origin - model.origin);
    for (V3f& p : mesh.positions) p += shift;
    snap_to(model.grid, mesh);
    EXPECT_EQ(test::corners(mesh), test::corners(split_vertices(model)));
  }
}

TEST(WriteGlb, StatesTheBoundsOfStoredIntegers) {
  BakedModel model = bare_cube();
  model.grid = {{-0.5f, -0.5f, -0.5f}, 1, 10, 10, 8};
  Json const position = json_of(model, {Profile::plain})["accessors"][0];
  EXPECT_EQ(position["min"], Json::array({0, 0, 0}));
  EXPECT_EQ(position["max"], Json::array({1023, 1023, 1023}));
}

TEST(WriteGlb, LargeMeshesGetLongIndices) {
  BakedModel model;
  model.mesh = test::grid(300, 300);
  model.grid = {{0, -150, 0}, 300, 16, 11, 8};
  Glb const glb = parse(encode(model, "", {Profile::plain}).glb);
  EXPECT_EQ(glb.json["accessors"][1]["componentType"], 5125);
  EXPECT_EQ(dequantise(glb).triangles.size(), model.mesh.triangles.size());
}

TEST(WriteGlb, FineNormalsTakeSixteenBits) {
  BakedModel model = test::random_model(1);
  model.grid.normal_bits = 10;
  Json const json = json_of(model, {Profile::plain});
  EXPECT_EQ(json["accessors"][1]["componentType"], 5122);
  EXPECT_EQ(json["bufferViews"][0]["byteStride"], 24);
}

TEST(WriteGlb, ChartTangentsBecomeUnitVectorsOfFour) {
  for (Profile profile : kProfiles) {
    BakedModel model = with_all_maps();
    Json const json = json_of(model, {profile});
    Json const& attributes = json["meshes"][0]["primitives"][0]["attributes"];
    Json const& accessor = json["accessors"][attributes["TANGENT"].get<std::size_t>()];
    EXPECT_EQ(accessor["type"], "VEC4");
    EXPECT_EQ(accessor["componentType"], profile == Profile::web || profile == Profile::core ? 5126 : 5120);
    model.normal.reset();
    model.chart_tangents.clear();
    EXPECT_FALSE(json_of(model, {profile})["meshes"][0]["primitives"][0]["attributes"].contains("TANGENT"));
  }
}

TEST(WriteGlb, NamesTheNodeAndMendsBadText) {
  EXPECT_EQ(json_of(bare_cube(), {}, "Fatih Camii \"北\"\n")["nodes"][0]["name"], "Fatih Camii \"北\"\n");
  EXPECT_EQ(json_of(bare_cube(), {}, "caf\xE9")["nodes"][0]["name"], "caf\uFFFD");
  EXPECT_FALSE(json_of(bare_cube())["nodes"][0].contains("name"));
}

TEST(WriteGlb, FarOriginsKeepTheirDigits) {
  BakedModel model = bare_cube();
  EXPECT_FALSE(json_of(model)["nodes"][0].contains("translation"));
  model.origin = {4513876.123, -25.5, 1e7};
  EXPECT_EQ(json_of(model)["nodes"][0]["translation"], Json::array({4513876.123, -25.5, 1e7}));
  EXPECT_EQ(json_of(model, {Profile::plain})["nodes"][0]["translation"], Json::array({4513875.123, -26.5, 1e7 - 1}));
}

TEST(WriteGlb, MaterialsAreNotMetalAndSayNoMoreThanTheyMust) {
  EXPECT_EQ(json_of(bare_cube())["materials"][0], Json::parse(R"({"pbrMetallicRoughness":{"metallicFactor":0}})"));
}

TEST(WriteGlb, MaterialsCarryWhatTheModelHas) {
  BakedModel model = bare_cube();
  model.base_colour = {0.25f, 0.1f, 2, 1};
  model.alpha = AlphaMode::mask;
  model.alpha_cutoff = 0.25f;
  model.double_sided = model.unlit = true;
  Json const json = json_of(model);
  Json const& material = json["materials"][0];
  EXPECT_EQ(material["pbrMetallicRoughness"]["baseColorFactor"], Json::array({0.25, 0.1, 1, 1}));
  EXPECT_EQ(material["alphaMode"], "MASK");
  EXPECT_EQ(material["alphaCutoff"], 0.25);
  EXPECT_EQ(material["doubleSided"], true);
  EXPECT_TRUE(material["extensions"].contains("KHR_materials_unlit"));
  EXPECT_THAT(json["extensionsUsed"], testing::Contains("KHR_materials_unlit"));
  EXPECT_THAT(json["extensionsRequired"], testing::Not(testing::Contains("KHR_materials_unlit")));
}

TEST(WriteGlb, MapsAreFoundFromTheirMaterial) {
  for (Profile profile : kProfiles) {
    Glb const glb = parse(encode(with_all_maps(), "", {profile}).glb);
    Json const& material = glb.json["materials"][0];
    auto decoded = [&](Json const& map) {
      Json const& texture = glb.json["textures"][map["index"].get<std::size_t>()];
      Json const& source = texture.contains("source") ? texture : texture["extensions"]["EXT_texture_webp"];
      Json const& found = glb.json["images"][source["source"].get<std::size_t>()];
      return decode_image(view(glb, found["bufferView"].get<std::size_t>()), ColourSpace::linear);
    };
    EXPECT_EQ(decoded(material["pbrMetallicRoughness"]["baseColorTexture"]).width, 16);
    EXPECT_EQ(decoded(material["normalTexture"]).width, 16);
    Image const occlusion = decoded(material["occlusionTexture"]), wanted = image(1);
    double error = 0;
    for (std::size_t i = 0; i < 256; ++i)
      error += std::abs(occlusion.texels[i * static_cast<std::size_t>(occlusion.channels)] - wanted.texels[i]);
    EXPECT_LT(error / 256, 20);
  }
}

TEST(WriteGlb, TheColourMapFillsTheFileThatIsAskedFor) {
  BakedModel const model = with_all_maps();
  std::size_t const usual = encode(model, "").glb.size();
  int quality = 0;
  for (std::size_t most : {usual - 100, usual + 100, usual + 400}) {
    EncodedThumbnail const file = encode(model, "", {}, most);
    EXPECT_LE(file.glb.size(), most);
    EXPECT_GT(file.colour_quality, quality);
    quality = file.colour_quality;
  }
  EXPECT_EQ(encode(model, "", {}, 10).colour_quality, 5);
  EXPECT_EQ(encode(model, "", {}, 1'000'000).colour_quality, 95);
}

TEST(WriteGlb, PlainTakesPngWhereThereIsAlpha) {
  BakedModel model = with_all_maps();
  EXPECT_EQ(json_of(model, {Profile::plain})["images"][0]["mimeType"], "image/jpeg");
  model.colour = image(4);
  EXPECT_EQ(json_of(model, {Profile::plain})["images"][0]["mimeType"], "image/png");
  EXPECT_EQ(json_of(model, {Profile::web})["images"][0]["mimeType"], "image/webp");
}

TEST(WriteGlb, RefusesAModelWithoutTriangles) { EXPECT_THROW(encode(BakedModel{}, ""), Error); }

}  // namespace
}  // namespace vitrine::io
