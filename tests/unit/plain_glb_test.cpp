// SPDX-License-Identifier: Apache-2.0
#include "io/plain_glb.h"

#include "io/read_model.h"
#include "io/write_glb.h"
#include "stages/error.h"
#include "tests/support/delivered.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <optional>
#include <string_view>

namespace vitrine::io {
namespace {

using testing::HasSubstr;
using testing::Not;

std::vector<std::byte> web(BakedModel const& model) { return encode(model, "sphere", {}).glb; }

SourceModel read(std::vector<std::byte> const& glb) {
  Resolve const nothing = [](std::string_view) { return std::optional<Blob>(); };
  return read_model(".glb", own(glb), nothing);
}

std::string text_of(std::vector<std::byte> const& glb) {
  return {reinterpret_cast<char const*>(glb.data()), glb.size()};
}

/// How far the farthest vertex of one is from the other's nearest.
float apart(SourceModel const& one, SourceModel const& other) {
  float farthest = 0;
  for (V3f const& p : one.mesh.positions) {
    float nearest = 1e9f;
    for (V3f const& q : other.mesh.positions) nearest = std::min(nearest, (p - q).length());
    farthest = std::max(farthest, nearest);
  }
  return farthest;
}

TEST(PlainGlb, NeedsNoDecoderAndShowsTheSame) {
  for (BakedModel const& model : {test::random_model(3), test::coloured_model(3)}) {
    std::vector<std::byte> const coded = web(model), plain = plain_glb(coded);
    EXPECT_THAT(text_of(plain), Not(HasSubstr("draco")));
    EXPECT_THAT(text_of(plain), HasSubstr("KHR_mesh_quantization"));
    EXPECT_THAT(text_of(plain), HasSubstr("\"name\":\"sphere\""));
    SourceModel const there = read(coded), here = read(plain);
    EXPECT_EQ(here.mesh.triangles.size(), there.mesh.triangles.size());
    EXPECT_LT(apart(here, there), 1e-4f);
    EXPECT_EQ(here.images.size(), there.images.size());
  }
}

TEST(PlainGlb, IsEmptyWhereThereIsNothingToUnpack) {
  EXPECT_TRUE(plain_glb(encode(test::coloured_model(1), "", {.profile = Profile::plain}).glb).empty());
}

TEST(PlainGlb, RefusesWhatIsDamaged) {
  std::vector<std::byte> damaged = web(test::random_model(1));
  damaged.resize(damaged.size() / 2);
  EXPECT_THROW(plain_glb(damaged), Error);
}

}  // namespace
}  // namespace vitrine::io
