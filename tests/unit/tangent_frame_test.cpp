// SPDX-License-Identifier: Apache-2.0
#include "stages/tangent_frame.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

namespace vitrine {
namespace {

std::array<V3f, 3> const kCorners{V3f(0, 0, 0), V3f(2, 0, 0), V3f(0, 1, 0)};
/// u along +X, v down along -Y, as an image lies on a wall seen from the front.
CornerUvs const kUpright{V2f(0, 1), V2f(1, 1), V2f(0, 0)};

/// What the client's shader computes at a pixel: its derivatives, its two matrix columns, its sign of y.
V3f shaded(std::array<V3f, 3> const& p, CornerUvs const& uv, V3f const& n, V3f const& m, V3f right, V3f up) {
  V3f const e1 = p[1] - p[0], e2 = p[2] - p[0], face = e1.cross(e2);
  auto const across = [&](V3f const& step) {
    // The place on the triangle's plane under the next pixel, and the uv there.
    V3f const view = right.cross(up), on_plane = step - view * (step.dot(face) / view.dot(face));
    float const u = on_plane.cross(e2).dot(face) / face.length2(), v = e1.cross(on_plane).dot(face) / face.length2();
    return std::pair(on_plane, (uv[1] - uv[0]) * u + (uv[2] - uv[0]) * v);
  };
  auto const [q0, st0] = across(right);
  auto const [q1, st1] = across(up);
  V3f const q1perp = q1.cross(n), q0perp = n.cross(q0);
  V3f const t = q1perp * st0.x + q0perp * st1.x, b = q1perp * st0.y + q0perp * st1.y;
  float const det = std::max(t.dot(t), b.dot(b)), scale = det == 0 ? 0 : 1 / std::sqrt(det);
  return (t * scale * m.x + b * scale * -m.y + n * m.z).normalized();
}

float degrees_between(V3f const& a, V3f const& b) { return std::atan2(a.cross(b).length(), a.dot(b)) * 57.29578f; }

struct Random {
  std::mt19937 engine;
  float operator()(float low, float high) { return std::uniform_real_distribution<float>(low, high)(engine); }
  V3f direction() { return V3f((*this)(-1, 1), (*this)(-1, 1), (*this)(-1, 1)).normalized(); }
};

TEST(TangentFrame, AnUprightImageHasUForRightAndGreenForUp) {
  TangentFrame const frame = client_frame(kCorners, kUpright, {0, 0, 1});
  EXPECT_EQ(frame.tangent, V3f(0.5f, 0, 0));
  EXPECT_EQ(frame.bitangent, V3f(0, 1, 0));
  EXPECT_EQ(frame.normal, V3f(0, 0, 1));
}

TEST(TangentFrame, TheLongerGradientHasLengthOne) {
  TangentFrame const frame = client_frame({V3f(0, 0, 0), V3f(1, 0, 0), V3f(0, 5, 0)}, kUpright, {0, 0, 1});
  EXPECT_FLOAT_EQ(frame.tangent.length(), 1);
  EXPECT_FLOAT_EQ(frame.bitangent.length(), 0.2f);
}

TEST(TangentFrame, ATriangleWithoutUvAreaShowsItsNormal) {
  TangentFrame const frame = client_frame(kCorners, {V2f(0.5f), V2f(0.5f), V2f(0.5f)}, {0, 0, 1});
  EXPECT_EQ(from_tangent_space(frame, V3f(0.6f, 0, 0.8f)), V3f(0, 0, 1));
  EXPECT_EQ(to_tangent_space(frame, V3f(0.6f, 0, 0.8f)), V3f(0, 0, 1));
}

TEST(TangentFrame, ShowsWhatTheClientsShaderShowsFromAnyView) {
  Random random{std::mt19937(3)};
  for (int i = 0; i < 300; ++i) {
    std::array<V3f, 3> const p{random.direction(), random.direction(), random.direction()};
    CornerUvs const uv{V2f(random(0, 1), random(0, 1)), V2f(random(0, 1), random(0, 1)),
                       V2f(random(0, 1), random(0, 1))};
    V3f const face = (p[1] - p[0]).cross(p[2] - p[0]);
    if (face.length() < 0.2f || std::abs((uv[1] - uv[0]).cross(uv[2] - uv[0])) < 0.02f) continue;
    V3f const normal = (face.normalized() + random.direction() * 0.4f).normalized();
    V3f const m = V3f(random(-0.7f, 0.7f), random(-0.7f, 0.7f), 0.7f).normalized();
    V3f view = random.direction();
    if (view.dot(face) < 0) view = -view;
    if (view.dot(face.normalized()) < 0.2f) continue;
    V3f const right = V3f(0, 1, 0).cross(view).normalized() * 0.01f, up = view.cross(right);
    EXPECT_LT(degrees_between(shaded(p, uv, normal, m, right, up), from_tangent_space(client_frame(p, uv, normal), m)),
              0.1f);
  }
}

TEST(TangentFrame, ToIsTheInverseOfFromAlsoWhenSkewedOrMirrored) {
  Random random{std::mt19937(4)};
  for (int i = 0; i < 300; ++i) {
    std::array<V3f, 3> const p{random.direction(), random.direction(), random.direction()};
    CornerUvs const uv{V2f(random(0, 1), random(0, 1)), V2f(random(0, 1), random(0, 1)),
                       V2f(random(0, 1), random(0, 1))};
    V3f const normal = (p[1] - p[0]).cross(p[2] - p[0]).normalized();
    V3f wanted = random.direction();
    if (wanted.dot(normal) < 0.05f) continue;
    TangentFrame const frame = client_frame(p, uv, normal);
    if (frame.tangent.cross(frame.bitangent).length() < 0.05f) continue;
    V3f const m = to_tangent_space(frame, wanted);
    EXPECT_NEAR(m.length(), 1, 1e-6f);
    EXPECT_LT(degrees_between(from_tangent_space(frame, m), wanted), 0.1f);
  }
}

TEST(TangentFrame, WhatLiesBehindTheNormalIsShownAtTheHorizon) {
  TangentFrame const frame = client_frame(kCorners, kUpright, {0, 0, 1});
  V3f const m = to_tangent_space(frame, V3f(0, 0.6f, -0.8f));
  EXPECT_LT(degrees_between(from_tangent_space(frame, m), V3f(0, 1, 0)), 0.5f);
  EXPECT_GT(m.z, 0.0039f);
  EXPECT_EQ(to_tangent_space(frame, V3f(0, 0, -1)), V3f(0, 0, 1));
}

TEST(TangentFrame, CollinearGradientsReachWhatLiesAlongThem) {
  TangentFrame const frame = client_frame(kCorners, {V2f(0, 0), V2f(1, 1), V2f(0, 0)}, {0, 0, 1});
  V3f const wanted(0.6f, 0, 0.8f);
  EXPECT_LT(degrees_between(from_tangent_space(frame, to_tangent_space(frame, wanted)), wanted), 0.01f);
}

TEST(StoredFrame, TheBitangentIsNormalCrossTangent) {
  TangentFrame const frame = stored_frame({0, 0, 1}, {1, 0, 0});
  EXPECT_EQ(frame.tangent, V3f(1, 0, 0));
  EXPECT_EQ(frame.bitangent, V3f(0, 1, 0));
  EXPECT_EQ(stored_frame({0, 0.6f, 0.8f}, {0, 1, 0}).bitangent, V3f(-1, 0, 0));
}

TEST(StoredFrame, ToIsTheInverseOfFromWhereTheTangentLeans) {
  Random random{std::mt19937(5)};
  for (int i = 0; i < 300; ++i) {
    V3f const normal = random.direction(), tangent = random.direction();
    V3f const wanted = (normal + random.direction() * 0.4f).normalized();
    if (std::abs(normal.dot(tangent)) > 0.8f) continue;
    TangentFrame const frame = stored_frame(normal, tangent);
    EXPECT_LT(degrees_between(from_tangent_space(frame, to_tangent_space(frame, wanted)), wanted), 0.1f);
  }
}

TEST(StoredFrame, BeyondTheTangentTheNearestIsShown) {
  TangentFrame const frame = stored_frame({0, 0, 1}, V3f(1, 0, 1));  // shows what leans to +X by 45 degrees at most
  V3f const wanted = V3f(2, 0.5f, 1).normalized();
  V3f const nearest = (wanted - V3f(1, 0, -1) * (wanted.dot(V3f(1, 0, -1)) / 2)).normalized();
  V3f const m = to_tangent_space(frame, wanted);
  EXPECT_LT(degrees_between(from_tangent_space(frame, m), nearest), 0.5f);
  EXPECT_GT(m.z, 0.0039f);
}

TEST(StoredFrame, ATangentAlongTheNormalStillShowsTheNormal) {
  for (V3f const& tangent : {V3f(0, 0, 1), V3f(0.01f, 0, 1), V3f(0, 0, -1)}) {
    TangentFrame const frame = stored_frame({0, 0, 1}, tangent);
    EXPECT_LT(degrees_between(from_tangent_space(frame, to_tangent_space(frame, {0, 0, 1})), {0, 0, 1}), 0.01f);
    V3f const shown = from_tangent_space(frame, to_tangent_space(frame, V3f(0.3f, 0.3f, 1).normalized()));
    EXPECT_LT(degrees_between(shown, {0, 0, 1}), 45);
  }
}

}  // namespace
}  // namespace vitrine
