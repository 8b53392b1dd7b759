// SPDX-License-Identifier: Apache-2.0
#include "stages/bake.h"

#include "stages/colour.h"
#include "stages/quantize.h"
#include "stages/tangent_frame.h"
#include "tests/support/atlases.h"
#include "tests/support/meshes.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>

namespace vitrine {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::IsEmpty;

/// The unit square facing +Z.
TriMesh square() { return {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}}; }

SurveyedModel surveyed(SourceModel model) { return survey(std::make_shared<SourceModel const>(std::move(model))); }

QuantizedAtlas quantized(Atlas atlas) { return quantize(std::move(atlas), {14, 14, 10}); }

SourceModel coloured(TriMesh mesh, std::function<Rgba(V3f)> const& colour) {
  SourceModel model = test::plain_model(std::move(mesh));
  for (V3f const& p : model.mesh.positions) {
    Rgba const c = colour(p);
    model.colours.push_back({});
    for (int k = 0; k < 4; ++k) model.colours.back()[k] = std::uint16_t(std::lround(c[k] * 65535));
  }
  return model;
}

std::array<int, 3> texel(Image const& image, int x, int y) {
  std::uint8_t const* const t = &image.texels[(std::size_t(y) * image.width + x) * image.channels];
  return {t[0], t[1], t[2]};
}

BakeOptions only_colour() {
  BakeOptions options;
  options.normal_map = false;
  return options;
}

TEST(Bake, AModelWithoutColourIsWhiteWithoutMap) {
  BakedModel const model =
      bake(quantized(test::facing_atlas(square(), 16)), surveyed(test::plain_model(square())), only_colour());
  EXPECT_FALSE(model.colour || model.normal || model.occlusion);
  EXPECT_THAT(model.corner_uvs, IsEmpty());
  EXPECT_THAT(model.base_colour, ElementsAre(1, 1, 1, 1));
}

TEST(Bake, AModelOfOneColourNeedsNoMap) {
  auto const source = coloured(square(), [](V3f) { return Rgba{1, 0, 0.2f, 1}; });
  BakedModel const model = bake(quantized(test::facing_atlas(square(), 16)), surveyed(source), only_colour());
  EXPECT_FALSE(model.colour);
  EXPECT_NEAR(model.base_colour[2], 0.2f, 1e-4f);
}

TEST(Bake, TheSameMeshReproducesVertexColoursAtTexelCentres) {
  auto const source = coloured(square(), [](V3f p) { return Rgba{p.x, p.y, 1 - p.x, 1}; });
  int const size = 34;
  BakedModel const model = bake(quantized(test::facing_atlas(square(), size)), surveyed(source), only_colour());
  ASSERT_EQ(model.colour->channels, 3);
  for (int y = 1; y < size - 1; ++y)
    for (int x = 1; x < size - 1; ++x) {
      float const px = (float(x) - 0.5f) / 32, py = 1 - (float(y) - 0.5f) / 32;
      auto const [r, g, b] = texel(*model.colour, x, y);
      EXPECT_NEAR(r, 255 * linear_to_srgb(px), 1);
      EXPECT_NEAR(g, 255 * linear_to_srgb(py), 1);
      EXPECT_NEAR(b, 255 * linear_to_srgb(1 - px), 1);
    }
}

TEST(Bake, FineTexturesAverageInLinearLight) {
  SourceModel source = test::plain_model(square());
  for (V3f const& p : source.mesh.positions) source.uvs.emplace_back(p.x, 1 - p.y);
  Image board{256, 256, 1, ColourSpace::srgb, {}};
  for (int i = 0; i < 256 * 256; ++i) board.texels.push_back((i % 256 + i / 256) % 2 ? 255 : 0);
  source.images = {board};
  source.materials[0].coloured = true;
  source.materials[0].colour_map.image = 0;
  BakedModel const model = bake(quantized(test::facing_atlas(square(), 16)), surveyed(source), only_colour());
  EXPECT_THAT(model.colour->texels, Each(testing::AllOf(testing::Ge(186), testing::Le(190))));  // sRGB of one half: 188
}

TEST(Bake, ATiltedSourceNormalGivesTheMapValueOfItsAngle) {
  SourceModel source = test::plain_model(square());
  source.normals.assign(4, V3f(0, 0.6f, 0.8f));
  BakedModel const model = bake(quantized(test::facing_atlas(square(), 16)), surveyed(source));
  // T = +X and B = +Y of length 1, so m is the normal itself.
  EXPECT_EQ(texel(*model.normal, 8, 8), (std::array<int, 3>{128, 204, 230}));
}

TEST(Bake, TheLayOfTheChartLeavesTheFrameAlone) {
  TriMesh wide = square();
  for (V3f& p : wide.positions) p.x *= 2;
  SourceModel source = test::plain_model(wide);
  source.normals.assign(4, V3f(0.6f, 0, 0.8f));
  Atlas atlas = test::facing_atlas(square(), 16);
  atlas.mesh = wide;
  for (CornerUvs& uvs : atlas.corner_uvs)
    for (V2f& uv : uvs) uv = V2f(1 - uv.y, uv.x);
  EXPECT_EQ(texel(*bake(quantized(atlas), surveyed(source)).normal, 8, 8), (std::array<int, 3>{204, 128, 230}));
}

TEST(Bake, TheTangentIsTheFirstAxisAcrossTheChartsNormals) {
  TriMesh sideways = square();
  for (V3f& p : sideways.positions) p = V3f(p.z, p.x, p.y);  // faces +X
  Atlas atlas = test::facing_atlas(square(), 16);
  atlas.mesh = sideways;
  SourceModel source = test::plain_model(sideways);
  source.normals.assign(4, V3f(0.8f, 0.6f, 0));
  BakedModel const model = bake(quantized(atlas), surveyed(source));
  EXPECT_THAT(model.chart_tangents, ElementsAre(V3f(0, 1, 0)));
  EXPECT_THAT(model.face_charts, ElementsAre(0, 0));
  EXPECT_EQ(texel(*model.normal, 8, 8), (std::array<int, 3>{204, 128, 230}));
}

TEST(Bake, ANormalMapBringsNormalsAndTangents) {
  QuantizedAtlas const target = quantized(test::facing_atlas(square(), 16));
  SurveyedModel const original = surveyed(test::plain_model(square()));
  BakeOptions options;
  options.vertex_normals = false;
  EXPECT_EQ(bake(target, original, options).normals.size(), 4u);
  options.normal_map = false;
  EXPECT_THAT(bake(target, original, options).normals, IsEmpty());
  EXPECT_THAT(bake(target, original, only_colour()).chart_tangents, IsEmpty());
}

TEST(Bake, AThinPlateKeepsItsSidesApart) {
  TriMesh plate = test::cube({0.5f, 0.5f, 0});
  for (V3f& p : plate.positions) p.z *= 0.002f;
  SourceModel source = test::plain_model({});
  for (std::size_t f = 0; f < plate.triangles.size(); ++f)
    for (std::uint32_t const corner : plate.triangles[f]) {
      source.mesh.positions.push_back(plate.positions[corner]);
      bool const front = f == 2 || f == 3;
      source.colours.push_back(front ? Rgba16{65535, 0, 0, 65535} : Rgba16{0, 0, 65535, 65535});
    }
  for (std::uint32_t i = 0; i < 36; i += 3) source.mesh.triangles.push_back({i, i + 1, i + 2});
  // The light mesh lies a little behind the front, nearer to the back.
  TriMesh front = square();
  for (V3f& p : front.positions) p.z = -0.0009f;
  BakedModel const model = bake(quantized(test::facing_atlas(front, 16)), surveyed(source), only_colour());
  for (int y = 2; y < 14; ++y)
    for (int x = 2; x < 14; ++x) EXPECT_EQ(texel(*model.colour, x, y), (std::array<int, 3>{255, 0, 0}));
}

TEST(Bake, BilinearLookupInsideAChartReadsNoOtherChart) {
  TriMesh const mesh = test::two_shells();
  float const middle = bounds(mesh).center().x;
  auto const red = [&](V3f p) { return p.x < middle; };
  auto const source = coloured(mesh, [&](V3f p) { return red(p) ? Rgba{1, 0, 0, 1} : Rgba{0, 0, 1, 1}; });
  int const size = 64;
  QuantizedAtlas const target = quantized(test::scattered_atlas(mesh, size));
  BakedModel const model = bake(target, surveyed(source), only_colour());
  for (std::size_t f = 0; f < target.atlas.mesh.triangles.size(); ++f) {
    bool const is_red = red(target.atlas.mesh.positions[target.atlas.mesh.triangles[f][0]]);
    for (int i = 0; i <= 10; ++i)
      for (int j = 0; i + j <= 10; ++j) {
        CornerUvs const& uv = target.atlas.corner_uvs[f];
        V2f const at = (uv[0] + (uv[1] - uv[0]) * ((float(i) + 0.01f) / 10.03f) +
                        (uv[2] - uv[0]) * ((float(j) + 0.01f) / 10.03f)) *
                       float(size);
        for (int k = 0; k < 4; ++k)
          ASSERT_EQ(texel(*model.colour, int(at.x - 0.5f) + k % 2, int(at.y - 0.5f) + k / 2)[0], is_red ? 255 : 0);
      }
  }
}

TEST(Bake, OutOfReachTheClosestPointIsUsedAndCounted) {
  auto const source = coloured(square(), [](V3f p) { return Rgba{p.x, 0, 0, 1}; });
  TriMesh far = square();
  for (V3f& p : far.positions) p.z = 1;
  BakedModel const model = bake(quantized(test::facing_atlas(far, 16)), surveyed(source), only_colour());
  EXPECT_EQ(model.statistics.misses, model.statistics.samples);
  EXPECT_NEAR(texel(*model.colour, 8, 8)[0], 255 * linear_to_srgb(7.5f / 14), 1);
}

TEST(Bake, ASheetSeenFromBehindShowsItsNormalTurnedRound) {
  SourceModel source = test::plain_model(square());
  source.mesh.triangles = {{0, 2, 1}, {0, 3, 2}};
  source.normals.assign(4, {0, 0, -1});
  BakedModel const model = bake(quantized(test::facing_atlas(square(), 16)), surveyed(source));
  EXPECT_EQ(texel(*model.normal, 8, 8), (std::array<int, 3>{128, 128, 255}));
}

TEST(Bake, MissesAreZeroOnTheOriginalItself) {
  TriMesh const mesh = test::bumpy_sphere(24, 16);
  BakedModel const model = bake(quantized(test::scattered_atlas(mesh, 256)), surveyed(test::plain_model(mesh)));
  EXPECT_EQ(model.statistics.misses, 0u);
  EXPECT_GT(model.statistics.texels, 128u * 128);
  EXPECT_GT(model.statistics.samples, 6 * model.statistics.texels);
}

TEST(Bake, AlphaStaysOnlyWhereSomethingIsTransparent) {
  auto clear = [](V3f p) { return Rgba{p.x, 1, 1, p.x}; };
  SourceModel source = coloured(square(), clear);
  source.materials[0].alpha = AlphaMode::blend;
  QuantizedAtlas const target = quantized(test::facing_atlas(square(), 16));
  BakedModel model = bake(target, surveyed(source), only_colour());
  EXPECT_EQ(model.colour->channels, 4);
  EXPECT_EQ(model.alpha, AlphaMode::blend);
  for (Rgba16& c : source.colours) c[3] = 65535;
  model = bake(target, surveyed(source), only_colour());
  EXPECT_EQ(model.colour->channels, 3);
  EXPECT_EQ(model.alpha, AlphaMode::opaque);
}

TEST(Bake, TransparentPartsDoNotTintTheColour) {
  SourceModel source = coloured(square(), [](V3f p) { return p.x > 0 ? Rgba{1, 0, 0, 1} : Rgba{0, 1, 0, 0}; });
  source.mesh.positions[0].x = source.mesh.positions[3].x = 0;
  source.materials[0].alpha = AlphaMode::mask;
  BakedModel const model = bake(quantized(test::facing_atlas(square(), 4)), surveyed(source), only_colour());
  EXPECT_EQ(model.alpha, AlphaMode::mask);
  EXPECT_GT(texel(*model.colour, 2, 2)[0], texel(*model.colour, 2, 2)[1]);
}

TEST(Bake, UnlitAndDoubleSidedAreCarriedOver) {
  SourceModel source = test::painted_model(test::cube());
  QuantizedAtlas const target = quantized(test::scattered_atlas(test::cube(), 64));
  EXPECT_FALSE(bake(target, surveyed(source)).double_sided);
  source.materials[0].unlit = source.materials[0].double_sided = true;
  BakedModel const model = bake(target, surveyed(source));
  EXPECT_TRUE(model.unlit && model.double_sided);
  EXPECT_FALSE(model.normal);
  EXPECT_THAT(model.normals, IsEmpty());
}

TEST(Bake, ABoundaryMakesTheMeshDoubleSided) {
  EXPECT_TRUE(bake(quantized(test::facing_atlas(square(), 16)), surveyed(test::plain_model(square()))).double_sided);
}

TEST(Bake, NormalsAreWhatTheirCodeDecodesTo) {
  BakedModel const model =
      bake(quantized(test::scattered_atlas(test::bumpy_sphere(12, 8), 64)), surveyed(test::plain_model(test::cube())));
  for (V3f const& normal : model.normals) EXPECT_EQ(quantize_normal(normal, 10), normal);
}

TEST(Bake, OcclusionGoesToItsOwnMapOrToTheColour) {
  SurveyedModel const original = survey(std::make_shared<SourceModel const>(test::plain_model(square())), 64);
  QuantizedAtlas const target = quantized(test::facing_atlas(square(), 16));
  BakeOptions options = only_colour();
  EXPECT_FALSE(bake(target, original, options).occlusion);
  options.occlusion = Occlusion::occlusion;
  BakedModel model = bake(target, original, options);
  EXPECT_THAT(model.occlusion->texels, Each(255));
  EXPECT_FALSE(model.colour);
  options.occlusion = Occlusion::colour;
  model = bake(target, original, options);
  EXPECT_THAT(model.colour->texels, Each(255));
  EXPECT_FALSE(model.occlusion);
}

/// A floor with a pit that is deeper than it is wide, red at the bottom; walls are not needed.
SourceModel pit() {
  TriMesh mesh{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {.4f, .4f, 0}, {.6f, .4f, 0}, {.6f, .6f, 0}, {.4f, .6f, 0}},
               {{0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}}};
  for (V3f const& p : {V3f(.4f, .4f, -.3f), V3f(.6f, .4f, -.3f), V3f(.6f, .6f, -.3f), V3f(.4f, .6f, -.3f)})
    mesh.positions.push_back(p);
  mesh.triangles.insert(mesh.triangles.end(), {{8, 9, 10}, {8, 10, 11}});
  return coloured(mesh, [](V3f p) { return p.z < 0 ? Rgba{1, 0, 0, 1} : Rgba{0, 0, 1, 1}; });
}

TEST(Bake, ShootingAlongNormalsSeesTheBottomOfAPitTheNearestPointItsRim) {
  BakeOptions options = only_colour();
  options.reach = 0.5;
  QuantizedAtlas const lid = quantized(test::facing_atlas(square(), 32));
  EXPECT_THAT(texel(*bake(lid, surveyed(pit()), options).colour, 16, 16), ElementsAre(255, 0, 0));
  options.transfer = Transfer::nearest;
  BakedModel const nearest = bake(lid, surveyed(pit()), options);
  EXPECT_THAT(texel(*nearest.colour, 16, 16), ElementsAre(0, 0, 255));
  EXPECT_EQ(nearest.statistics.misses, 0u);
}

TEST(Bake, DerivedNormalsShowTheSameInTheFrameOfClientsWithoutTangent) {
  BakeOptions options;
  EXPECT_FALSE(
      bake(quantized(test::facing_atlas(square(), 16)), surveyed(test::plain_model(square())), options).derived_normal);
  options.derived_normals = true;
  SourceModel tilted = test::plain_model(square());
  V3f const wanted = V3f(0.3f, 0.2f, 1).normalized();
  tilted.normals.assign(4, wanted);
  QuantizedAtlas const target = quantized(test::facing_atlas(square(), 16));
  BakedModel const model = bake(target, surveyed(tilted), options);
  auto const t = texel(*model.derived_normal, 8, 8);
  V3f const m(float(t[0]) / 127.5f - 1, float(t[1]) / 127.5f - 1, float(t[2]) / 127.5f - 1);
  TriMesh const& mesh = target.atlas.mesh;
  Triangle const& face = mesh.triangles[0];
  TangentFrame const frame = client_frame({mesh.positions[face[0]], mesh.positions[face[1]], mesh.positions[face[2]]},
                                          target.atlas.corner_uvs[0], {0, 0, 1});
  EXPECT_GT(from_tangent_space(frame, m).dot(wanted), 0.9999f);
}

TEST(Bake, ModelsWithColourGetNoOcclusion) {
  BakeOptions options;
  options.occlusion = Occlusion::occlusion;
  SurveyedModel const original = survey(std::make_shared<SourceModel const>(test::painted_model(square())), 64);
  EXPECT_FALSE(bake(quantized(test::facing_atlas(square(), 16)), original, options).occlusion);
}

}  // namespace
}  // namespace vitrine
