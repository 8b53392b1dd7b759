// SPDX-License-Identifier: Apache-2.0
#include "stages/bake.h"

#include "stages/clean.h"
#include "stages/quantize.h"
#include "stages/tangent_frame.h"
#include "tests/support/atlases.h"
#include "tests/support/meshes.h"

#include <gmock/gmock.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <cmath>

namespace vitrine {
namespace {

struct Case {
  char const* name;
  TriMesh mesh;
};

void PrintTo(Case const& c, std::ostream* out) { *out << c.name; }

class AnyMesh : public testing::TestWithParam<Case> {
 protected:
  static SurveyedModel surveyed(SourceModel model) {
    return survey(std::make_shared<SourceModel const>(clean(std::move(model)).model));
  }
  static QuantizedAtlas target() { return quantize(test::scattered_atlas(GetParam().mesh, 128)); }
};

INSTANTIATE_TEST_SUITE_P(
    Bake, AnyMesh,
    testing::Values(Case{"triangle", test::triangle()}, Case{"tetrahedron", test::tetrahedron()},
                    Case{"cube", test::cube()}, Case{"far_cube", test::cube({1e4f, -2e4f, 3e4f}, 10)},
                    Case{"tiny_cube", test::cube({0, 0, 0}, 1e-6f)}, Case{"open_cone", test::open_cone()},
                    Case{"grid", test::grid(6, 5)}, Case{"sphere", test::sphere(12, 8)},
                    Case{"torus", test::torus(12, 8)}, Case{"moebius", test::moebius(16)},
                    Case{"non_manifold_edge", test::non_manifold_edge()}, Case{"two_shells", test::two_shells()},
                    Case{"bumpy_1", test::bumpy_sphere(12, 8, 1)}, Case{"bumpy_2", test::bumpy_sphere(14, 9, 2)}),
    [](auto const& chosen) { return chosen.param.name; });

TEST_P(AnyMesh, ConstantColourInConstantColourOut) {
  SourceModel source = test::plain_model(GetParam().mesh);
  Image const one{1, 1, 3, ColourSpace::srgb, {200, 100, 3}};
  source.uvs.assign(source.mesh.positions.size(), V2f(0.3f, 0.4f));
  source.images = {one};
  source.materials[0].coloured = true;
  source.materials[0].colour_map.image = 0;
  BakedModel const model = bake(target(), surveyed(source));
  ASSERT_TRUE(model.colour);
  for (std::size_t i = 0; i < model.colour->texels.size(); ++i)
    ASSERT_EQ(model.colour->texels[i], one.texels[i % 3]) << i / 3;
}

/// What the client shows at the middle of each face is the original's shading normal there.
TEST_P(AnyMesh, NormalMapsReproduceTheOriginalsNormals) {
  SourceModel source = clean(test::plain_model(GetParam().mesh)).model;
  for (std::size_t v = 0; v < source.normals.size(); ++v) {
    V3f const tilt(std::sin(float(v)), std::cos(3 * float(v)), std::sin(2 * float(v)));
    source.normals[v] = (source.normals[v] + tilt * 0.3f).normalized();
  }
  SurveyedModel const original = survey(std::make_shared<SourceModel const>(source));
  QuantizedAtlas const light = quantize(test::scattered_atlas(source.mesh, 128), {16, 16, 14});
  BakedModel const model = bake(light, original);
  ASSERT_EQ(light.atlas.mesh.triangles.size(), source.mesh.triangles.size());
  for (std::uint32_t f = 0; f < source.mesh.triangles.size(); ++f) {
    V3f drawn(0);
    for (int k = 0; k < 3; ++k) drawn += model.normals[model.mesh.triangles[f][k]];
    if (drawn.length() < 0.5f) continue;
    V2f const uv = (model.corner_uvs[f][0] + model.corner_uvs[f][1] + model.corner_uvs[f][2]) / 3.f;
    std::size_t const texel = std::size_t(uv.y * 128) * 128 + std::size_t(uv.x * 128);
    std::uint8_t const* const rgb = &model.normal->texels[3 * texel];
    V3f const m = V3f(float(rgb[0]), float(rgb[1]), float(rgb[2])) / 127.5f - V3f(1);
    V3f const wanted = original.surface.sample({f, 1.f / 3, 1.f / 3}, 0).normal;
    if (wanted.dot(drawn.normalized()) < 0.3f) continue;
    TangentFrame const frame = stored_frame(drawn.normalized(), model.chart_tangents[model.face_charts[f]]);
    EXPECT_GT(from_tangent_space(frame, m).dot(wanted), 0.99f) << "face " << f;
  }
}

TEST_P(AnyMesh, TheSameBytesWithOneThreadAndWithFour) {
  SurveyedModel const original = surveyed(test::painted_model(GetParam().mesh));
  QuantizedAtlas const light = target();
  tbb::global_control const allow(tbb::global_control::max_allowed_parallelism, 4);
  BakedModel one, four;
  tbb::task_arena(1).execute([&] { one = bake(light, original); });
  tbb::task_arena(4).execute([&] { four = bake(light, original); });
  EXPECT_EQ(one.colour.has_value(), four.colour.has_value());
  if (one.colour) {
    EXPECT_TRUE(one.colour->texels == four.colour->texels);
  }
  EXPECT_TRUE(one.normal->texels == four.normal->texels);
  EXPECT_EQ(one.statistics.misses, four.statistics.misses);
}

}  // namespace
}  // namespace vitrine
