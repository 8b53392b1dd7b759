// SPDX-License-Identifier: Apache-2.0
#include "stages/pack.h"

#include <gmock/gmock.h>

#include <cmath>

#include "stages/error.h"
#include "stages/texel_mask.h"
#include "tests/support/meshes.h"

namespace vitrine::test {
namespace {

using testing::IsEmpty;

/// `n` charts, each one flat square of the given size.
FlatCharts squares(std::size_t n, float size = 1) {
  FlatCharts flat;
  for (std::size_t c = 0; c < n; ++c) {
    std::uint32_t const v = std::uint32_t(4 * c);
    for (V2f p : {V2f(0, 0), V2f(size, 0), V2f(size, size), V2f(0, size)})
      flat.mesh.positions.push_back({p.x, p.y, float(c)});
    flat.mesh.triangles.push_back({v, v + 1, v + 2});
    flat.mesh.triangles.push_back({v, v + 2, v + 3});
    flat.corner_uvs.push_back({V2f(0, 0), V2f(size, 0), V2f(size, -size)});
    flat.corner_uvs.push_back({V2f(0, 0), V2f(size, -size), V2f(0, -size)});
    flat.face_charts.insert(flat.face_charts.end(), 2, std::uint32_t(c));
    flat.stretch.push_back(1);
  }
  flat.charts = std::uint32_t(n);
  return flat;
}

float side(Atlas const& atlas, std::size_t face) {
  return (atlas.corner_uvs[face][1] - atlas.corner_uvs[face][0]).length();
}

TEST(Pack, OneSquareFillsTheTextureUpToTheBorder) {
  Atlas const atlas = pack(squares(1), {.texture = 64, .gutter = 2});
  EXPECT_THAT(check(atlas), IsEmpty());
  EXPECT_GT(atlas.fill, 0.9f);  // 62 x 62 of 64 x 64 are to be had
}

TEST(Pack, FourSquaresFillTheTexture) {
  Atlas const atlas = pack(squares(4), {.texture = 64, .gutter = 2});
  EXPECT_THAT(check(atlas), IsEmpty());
  EXPECT_GT(atlas.fill, 0.82f);  // 4 x 30 x 30 of 64 x 64 are to be had
}

TEST(Pack, ALargeAtlasIsPackedByLargerSquares) {
  Atlas const atlas = pack(squares(4), {.texture = 2048, .gutter = 2});
  EXPECT_THAT(check(atlas), IsEmpty());
  EXPECT_GT(atlas.fill, 0.97f);
}

TEST(Pack, OneScaleForAll) {
  FlatCharts flat = squares(2);
  for (CornerUvs& uvs : {std::ref(flat.corner_uvs[2]), std::ref(flat.corner_uvs[3])})
    for (V2f& uv : uvs) uv *= 0.5f;
  Atlas const atlas = pack(flat, {.texture = 128});
  EXPECT_NEAR(side(atlas, 0), 2 * side(atlas, 2), 1e-5);
}

TEST(Pack, BoxesKeepTheGutterToo) {
  Atlas const atlas = pack(squares(7), {.texture = 64, .gutter = 3, .packing = Packing::boxes});
  EXPECT_THAT(check(atlas), IsEmpty());
}

TEST(Pack, ScaleOfTheModelDoesNotMatter) {
  Atlas const small = pack(squares(5, 1e-12f), {.texture = 64}), large = pack(squares(5, 1e12f), {.texture = 64});
  EXPECT_NEAR(side(small, 0), side(large, 0), 1e-4);
}

TEST(Pack, AChartWithoutAreaOwnsATexel) {
  FlatCharts flat = squares(2);
  flat.corner_uvs[2] = flat.corner_uvs[3] = {V2f(0), V2f(0), V2f(0)};
  Atlas const atlas = pack(flat, {.texture = 32});
  EXPECT_THAT(check(atlas), IsEmpty());
  EXPECT_GT(atlas.corner_uvs[2][0].x, 0);
}

TEST(Pack, NothingButDotsIsPacked) {
  FlatCharts flat = squares(3);
  flat.corner_uvs.assign(6, {V2f(0), V2f(0), V2f(0)});
  EXPECT_THAT(check(pack(flat, {.texture = 16})), IsEmpty());
}

TEST(Pack, SaysWhenThereAreMoreChartsThanRoom) {
  try {
    pack(squares(100), {.texture = 16, .gutter = 2});
    FAIL();
  } catch (Error const& error) {
    EXPECT_EQ(error.kind(), ErrorKind::limit_exceeded);
    EXPECT_STREQ(error.what(), "100 charts with a gutter of 2 texels do not fit in 16 x 16 texels");
  }
}

TEST(Pack, SaysWhenTheGutterLeavesNoRoom) { EXPECT_THROW(pack(squares(1), {.texture = 16, .gutter = 16}), Error); }

TEST(TexelMask, CoversEachTexelThatATriangleTouches) {
  TexelMask mask(4, 4);
  mask.cover({V2d(0.5, 0.5), V2d(2.5, 0.5), V2d(0.5, 2.5)});
  // Its long side runs from (2.5, 0.5) to (0.5, 2.5): through the corner (2, 1), hence through nothing of (2, 1) but a
  // point.
  EXPECT_EQ(mask.count(), 8u);
  EXPECT_TRUE(mask.at(2, 1));
  EXPECT_FALSE(mask.at(2, 2));
}

TEST(TexelMask, AddsAMarginAllAround) {
  TexelMask dot(1, 1), mask(70, 9);
  dot.cover({V2d(0.5, 0.5), V2d(0.5, 0.5), V2d(0.5, 0.5)});
  mask.add(dot, {65, 4}, 2);
  EXPECT_EQ(mask.count(), 25u);
  EXPECT_TRUE(mask.at(63, 2) && mask.at(67, 6));
  mask.add(dot, {0, 0}, 2);  // cut at the corner
  EXPECT_EQ(mask.count(), 34u);
}

TEST(TexelMask, FindsTheLowestRoom) {
  TexelMask taken(8, 4), block(8, 2), dot(1, 1);
  block.cover({V2d(0.1, 0.1), V2d(6.5, 0.1), V2d(6.5, 1.9)});
  block.cover({V2d(0.1, 0.1), V2d(6.5, 1.9), V2d(0.1, 1.9)});
  dot.cover({V2d(0.5, 0.5), V2d(0.5, 0.5), V2d(0.5, 0.5)});
  EXPECT_EQ(taken.room_for(block), V2i(0, 0));
  taken.add(block, {0, 0}, 0);
  EXPECT_EQ(taken.room_for(dot), V2i(7, 0));
  EXPECT_EQ(taken.room_for(block), V2i(0, 2));
  taken.add(block, {0, 1}, 1);
  EXPECT_FALSE(taken.room_for(block));
}

}  // namespace
}  // namespace vitrine::test
