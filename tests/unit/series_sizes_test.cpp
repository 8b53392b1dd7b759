// SPDX-License-Identifier: Apache-2.0
#include "graph/series_sizes.h"

#include "stages/clean.h"
#include "stages/error.h"
#include "tests/support/meshes.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace vitrine::graph {
namespace {

Reference made(SourceModel model, MeasureOptions options = {}) {
  options.size = 48;
  return reference(survey(std::make_shared<SourceModel const>(clean(std::move(model)).model)), options);
}

/// Without a symmetry that a turn could hide.
SourceModel lopsided() { return test::painted_model(test::bumpy_sphere(24, 12)); }

TEST(SeriesSizes, FewerFramesWeighLessAndAreFurtherOffWhenTurned) {
  for (SeriesSizes const& coding : series_sizes(made(lopsided()))) {
    ASSERT_EQ(coding.sizes.size(), 3u);
    for (std::size_t i = 1; i < 3; ++i) {
      EXPECT_LT(coding.sizes[i - 1].bytes, coding.sizes[i].bytes) << coding.codec;
      EXPECT_GT(coding.sizes[i - 1].turning_mse1e4, coding.sizes[i].turning_mse1e4) << coding.codec;
    }
  }
}

TEST(SeriesSizes, WithAFrameForEachViewNothingIsLostBetweenFrames) {
  for (SeriesSizes const& coding : series_sizes(made(lopsided()))) {
    EXPECT_EQ(coding.sizes[2].frames, 32);
    EXPECT_EQ(coding.sizes[2].turning_mse1e4, coding.sizes[2].coding_mse1e4) << coding.codec;
    EXPECT_GT(coding.sizes[2].coding_mse1e4, 0);
    EXPECT_LT(coding.sizes[2].coding_mse1e4, 20) << coding.codec;
  }
}

TEST(SeriesSizes, CountsThatDoNotDivideTheViewsAreLeftOut) {
  MeasureOptions options;
  options.count = 24;
  std::vector<SeriesSizes> const series = series_sizes(made(lopsided(), options));
  ASSERT_EQ(series[0].sizes.size(), 1u);
  EXPECT_EQ(series[0].sizes[0].frames, 8);
}

TEST(SeriesSizes, OtherViewsThanTheTurntableAreRefused) {
  MeasureOptions options;
  options.views = ViewSet::sphere;
  EXPECT_THROW(series_sizes(made(lopsided(), options)), Error);
}

TEST(SeriesSizes, AreKeyedByCodingAndCount) {
  std::vector<SeriesSizes> const series{{"jpeg90", {{8, 1000, 0.5, 20}, {16, 2000, 0.5, 10}}},
                                        {"webp80", {{8, 500, 1, 21}}}};
  EXPECT_EQ(to_json(series).dump(), R"({"jpeg90":{"8":{"bytes":1000,"codingMse1e4":0.5,"turningMse1e4":20.0},)"
                                    R"("16":{"bytes":2000,"codingMse1e4":0.5,"turningMse1e4":10.0}},)"
                                    R"("webp80":{"8":{"bytes":500,"codingMse1e4":1.0,"turningMse1e4":21.0}}})");
}

}  // namespace
}  // namespace vitrine::graph
