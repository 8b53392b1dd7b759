// SPDX-License-Identifier: Apache-2.0
#include "stages/detail.h"

#include "stages/clean.h"
#include "tests/support/meshes.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace vitrine {
namespace {

/// One colour where x < 0, a checkerboard as fine as the vertices elsewhere.
SurveyedModel half_plain() {
  SourceModel model = test::plain_model(test::sphere(96, 48));
  for (std::size_t v = 0; v < model.mesh.positions.size(); ++v) {
    bool const dark = model.mesh.positions[v].x < 0 || v % 2 == 0;
    model.colours.push_back(dark ? Rgba16{9000, 9000, 9000, 65535} : Rgba16{60000, 60000, 60000, 65535});
  }
  return survey(std::make_shared<SourceModel const>(clean(std::move(model)).model));
}

TEST(Detail, TexelsGoWhereColoursVary) {
  TriMesh const light = test::sphere(24, 12);
  std::vector<float> const lengths = detail_lengths(light, sample_surface(half_plain(), 20'000));
  for (std::size_t f = 0; f < lengths.size(); ++f) {
    float x = 0;
    for (std::uint32_t v : light.triangles[f]) x += light.positions[v].x / 3;
    EXPECT_TRUE(x > -0.5f || lengths[f] < 0.75f) << x << ": " << lengths[f];
    EXPECT_TRUE(x < 0.5f || lengths[f] > 1.1f) << x << ": " << lengths[f];
  }
}

TEST(Detail, IsEvenWithoutColour) {
  SurveyedModel const bare =
      survey(std::make_shared<SourceModel const>(clean(test::plain_model(test::sphere())).model));
  EXPECT_THAT(detail_lengths(test::sphere(8, 4), sample_surface(bare, 1000)), testing::Each(1.f));
}

}  // namespace
}  // namespace vitrine
