// SPDX-License-Identifier: Apache-2.0
#include "stages/paint.h"

#include "io/mesh_codec.h"
#include "stages/clean.h"
#include "stages/colour.h"
#include "stages/mip_map.h"
#include "tests/support/delivered.h"
#include "tests/support/meshes.h"

#include <gmock/gmock.h>
#include <oneapi/tbb/global_control.h>

#include <memory>

namespace vitrine {
namespace {

constexpr std::size_t kSamples = 20'000;

/// `original` on its own mesh, coarser by nothing but the grid.
BakedModel painted(SourceModel original, PaintOptions const& options = {}) {
  SurveyedModel const model = survey(std::make_shared<SourceModel const>(clean(std::move(original)).model));
  TriMesh const mesh = weld(*model.model);
  return paint(quantize(mesh, cube_about(mesh, 12)), model, sample_surface(model, kSamples), options);
}

/// Linear light at each vertex, as a client shows it.
std::vector<V3f> shown(BakedModel const& model) {
  V3f const factor(model.base_colour[0], model.base_colour[1], model.base_colour[2]);
  std::vector<V3f> colours = model.colours;
  colours.resize(model.mesh.positions.size(), V3f(1));
  if (model.colour) {
    MipMap const map(*model.colour, ColourSpace::srgb);
    for (std::size_t f = 0; f < model.corner_uvs.size(); ++f)
      for (int k = 0; k < 3; ++k) {
        Rgba const c = map.sample(model.corner_uvs[f][k], 0, {});
        colours[model.mesh.triangles[f][k]] = {c[0], c[1], c[2]};
      }
  }
  for (V3f& colour : colours) colour *= factor;
  return colours;
}

Rgba16 code(V3f const& linear, float alpha = 1) {
  auto const k = [](float c) { return std::uint16_t(std::lround(65535 * c)); };
  return {k(linear.x), k(linear.y), k(linear.z), k(alpha)};
}

TEST(Paint, OneColourNeedsNoVertexColours) {
  SourceModel model = test::plain_model(test::cube());
  EXPECT_FALSE(painted(model).colour);
  model.colours.assign(model.mesh.positions.size(), code({0.25f, 0.5f, 0.125f}));
  BakedModel const one = painted(model);
  EXPECT_THAT(one.colours, testing::IsEmpty());
  EXPECT_FALSE(one.colour);
  EXPECT_NEAR(one.base_colour[1], 0.5f, 1e-4f);
}

TEST(Paint, EachShellKeepsItsColour) {
  SourceModel model = test::plain_model(test::two_shells());
  V3f const first(0.5f, 0.25f, 0.25f), second(0.25f, 0.5f, 0);
  for (std::size_t v = 0; v < 16; ++v) model.colours.push_back(code(v < 8 ? first : second));
  for (bool palette : {false, true}) {
    BakedModel const both = painted(model, {.palette = palette, .colour_bits = 8});
    std::vector<V3f> const colours = shown(both);
    for (std::size_t v = 0; v < 16; ++v) {
      bool const near_first = (both.mesh.positions[v] - both.mesh.positions[0]).length() < 1.8f;
      EXPECT_LT((colours[v] - (near_first ? first : second)).length(), 0.006f);
    }
  }
}

TEST(Paint, FollowsSmoothColours) {
  SourceModel const original = test::painted_model(test::sphere(48, 24));
  BakedModel const model = painted(original, {.palette = false, .colour_bits = 8, .smoothing = 0});
  std::vector<V3f> const colours = shown(model);
  double worst = 0;
  for (std::size_t v = 0; v < model.mesh.positions.size(); ++v) {
    float nearest = 1;
    V3f wanted(0);
    for (std::size_t i = 0; i < original.mesh.positions.size(); ++i)
      if (float const d = (original.mesh.positions[i] - model.mesh.positions[v]).length(); d < nearest) {
        nearest = d;
        Rgba16 const& c = original.colours[i];
        wanted = V3f(c[0], c[1], c[2]) / 65535;
      }
    for (unsigned k = 0; k < 3; ++k)
      worst = std::max<double>(worst, std::abs(linear_to_srgb(colours[v][k]) - linear_to_srgb(wanted[k])));
  }
  EXPECT_LT(worst, 0.03);
}

TEST(Paint, HardEdgesStayWithinTheUnitCube) {
  SourceModel model = test::plain_model(test::grid(16, 16));
  for (V3f const& p : model.mesh.positions) model.colours.push_back(code(p.x < 8 ? V3f(0) : V3f(1)));
  BakedModel const edge = painted(model, {.palette = false, .smoothing = 0});
  for (V3f const& colour : edge.colours)
    for (unsigned k = 0; k < 3; ++k) EXPECT_TRUE(colour[k] >= 0 && colour[k] <= 1) << colour;
  for (float c : edge.base_colour) EXPECT_LE(c, 1);
}

TEST(Paint, ColoursDecodeExactlyAsPainted) {
  for (bool palette : {false, true}) {
    BakedModel const model = painted(test::painted_model(test::torus()), {.palette = palette});
    io::VertexMesh const mesh = io::split_vertices(model);
    EXPECT_EQ(mesh.positions.size(), model.mesh.positions.size()) << "no vertex is split";
    EXPECT_EQ(test::corners(test::decode_draco(io::encode_draco(mesh, model.grid).bytes)), test::corners(mesh));
  }
}

TEST(Paint, HuesAllAroundNeedRedGreenAndBlue) {
  auto const three_hues = [](bool one_brightness) {
    SourceModel model = test::plain_model(test::grid(24, 24));
    for (V3f const& p : model.mesh.positions) {
      int const third = int(p.x / 8.5f);
      model.colours.push_back(code(V3f(third == 0, third == 1, third == 2) * (one_brightness ? 0.5f : p.z / 24)));
    }
    return painted(model);
  };
  EXPECT_TRUE(three_hues(true).palette) << "they lie in a plane";
  BakedModel const all = three_hues(false);
  EXPECT_FALSE(all.palette);
  EXPECT_THAT(all.colours, testing::Not(testing::IsEmpty()));
}

TEST(Paint, BlendsByTheMeanAndCannotCutOut) {
  SourceModel model = test::painted_model(test::sphere());
  for (Rgba16& c : model.colours) c[3] = 65535 / 4;
  model.materials[0].alpha = AlphaMode::blend;
  BakedModel const glass = painted(model);
  EXPECT_EQ(glass.alpha, AlphaMode::blend);
  EXPECT_NEAR(glass.base_colour[3], 0.25f, 1e-3f);
  model.materials[0].alpha = AlphaMode::mask;
  for (std::size_t v = 0; v < model.colours.size(); ++v) model.colours[v][3] = v % 2 ? 65535 : 0;
  BakedModel const lace = painted(model);
  EXPECT_EQ(lace.alpha, AlphaMode::opaque);
  EXPECT_EQ(lace.base_colour[3], 1);
}

TEST(Paint, NormalsOnRequestFollowTheShading) {
  SourceModel const sphere = test::plain_model(test::sphere());
  EXPECT_THAT(painted(sphere).normals, testing::IsEmpty());
  BakedModel const smooth = painted(sphere, {.normals = true, .normal_bits = 10});
  EXPECT_EQ(smooth.grid.normal_bits, 10);
  for (std::size_t v = 0; v < smooth.normals.size(); ++v) {
    EXPECT_GT(smooth.normals[v].dot(smooth.mesh.positions[v].normalized()), 0.999f);
    EXPECT_EQ(smooth.normals[v], quantize_normal(smooth.normals[v], 10));
  }
  SourceModel unlit = sphere;
  unlit.materials[0].unlit = true;
  EXPECT_THAT(painted(unlit, {.normals = true}).normals, testing::IsEmpty());
}

TEST(Paint, IsDoubleSidedWhereTheMeshIsOpen) {
  EXPECT_FALSE(painted(test::plain_model(test::cube())).double_sided);
  EXPECT_TRUE(painted(test::plain_model(test::open_cone())).double_sided);
}

TEST(Paint, GivesTheSameOnOneThreadAndTwo) {
  auto const with = [](std::size_t threads) {
    tbb::global_control const width(tbb::global_control::max_allowed_parallelism, threads);
    return painted(test::painted_model(test::bumpy_sphere(64, 32)), {.normals = true});
  };
  BakedModel const one = with(1), two = with(2);
  EXPECT_EQ(one.corner_uvs, two.corner_uvs);
  EXPECT_EQ(one.colour->texels, two.colour->texels);
  EXPECT_EQ(one.normals, two.normals);
  EXPECT_EQ(one.base_colour, two.base_colour);
}

}  // namespace
}  // namespace vitrine
