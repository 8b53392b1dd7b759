// SPDX-License-Identifier: Apache-2.0
#include "graph/preset.h"

#include "tools/model_flags.h"

#include <gtest/gtest.h>

namespace vitrine {
namespace {

graph::ModelOptions parsed(std::string const& line) {
  graph::ModelOptions options;
  CLI::App app;
  tools::add_model_flags(app, options);
  app.parse(line);
  return options;
}

TEST(Preset, PaperSetsThePapersChoices) {
  graph::ModelOptions const paper = parsed("--preset paper");
  EXPECT_EQ(paper.simplify.decimator, Decimator::openmesh);
  EXPECT_EQ(paper.pack.packing, Packing::boxes);
  EXPECT_EQ(paper.pack.texture, 256);
  EXPECT_EQ(paper.quantize.position_bits, 16);
  EXPECT_EQ(paper.quantize.uv_bits, 16);
  EXPECT_EQ(paper.bake.samples, 1);
  EXPECT_EQ(paper.bake.occlusion, Occlusion::colour);
  EXPECT_EQ(paper.encode.colour_codec, MapCodec::jpeg);
  EXPECT_EQ(paper.encode.colour_quality, 90);
  EXPECT_EQ(paper.encode.normal_codec, MapCodec::png);
  EXPECT_TRUE(paper.encode.x3dom);
}

TEST(Preset, FlagsWinOnEitherSideOfIt) {
  for (char const* line : {"--preset paper --texture 512 --no-x3dom", "--texture 512 --no-x3dom --preset paper"}) {
    graph::ModelOptions const options = parsed(line);
    EXPECT_EQ(options.pack.texture, 512) << line;
    EXPECT_FALSE(options.encode.x3dom) << line;
    EXPECT_EQ(options.simplify.decimator, Decimator::openmesh) << line;
  }
}

TEST(Preset, WithoutItNothingChanges) { EXPECT_EQ(parsed("").bake.samples, BakeOptions().samples); }

TEST(Preset, AnUnknownOneIsRefused) { EXPECT_THROW(parsed("--preset scroll"), CLI::ValidationError); }

}  // namespace
}  // namespace vitrine
