// SPDX-License-Identifier: Apache-2.0
#include "stages/render.h"

#include "stages/parallel.h"
#include "stages/shade.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace vitrine {
namespace {

constexpr int kSupersample = 4, kSamples = kSupersample * kSupersample;
constexpr int kTile = 2, kTilePixels = kTile * kTile;  ///< pixels that one packet of rays draws
static_assert(kTilePixels * kSamples == RayScene::kPacket);
constexpr int kMostLayers = 64;  ///< transparent ones that a ray passes before it sees the background
constexpr float kGrey = 0.5f;

/// One sample as the client's frame buffer holds it.
using Texel = std::array<std::uint8_t, 4>;

/// Draws one view of one model.
class Painter {
 public:
  Painter(SurveyedModel const& model, Camera const& camera, PictureOptions const& options)
      : model_(model), options_(options), camera_(camera), eye_(camera.eye - model.model->origin) {
    double const side = options.size * kSupersample;
    right_ = V3f((through(camera, 2 / side, 0) - camera.forward));
    up_ = V3f((through(camera, 0, 2 / side) - camera.forward));
    top_left_ = V3f(through(camera, 1 / side - 1, 1 - 1 / side));
    V3d const to_light = options.light == Light::head ? -camera.forward : camera.up - camera.right - camera.forward;
    to_light_ = V3f(to_light.normalized());
  }

  /// The 2 x 2 pixels from (x, y) on, row by row.
  std::array<Texel, kTilePixels> tile(int x, int y) const {
    std::array<Ray, RayScene::kPacket> const rays = rays_of(x, y);
    auto const hits = model_.scene.first_hits(rays);
    std::array<Texel, kTilePixels> pixels;
    for (int p = 0; p < kTilePixels; ++p) {
      Shading const shading = shading_at(x + p % kTile, y + p / kTile);
      std::array<int, 4> sums{};
      for (std::size_t i = p * kSamples; i < (p + 1u) * kSamples; ++i) {
        Texel const texel = hits[i] ? sample(rays[i], *hits[i], shading) : Texel{255, 255, 255, 0};
        for (std::size_t k = 0; k < 4; ++k) sums[k] += texel[k];
      }
      for (std::size_t k = 0; k < 4; ++k) pixels[p][k] = static_cast<std::uint8_t>((sums[k] + kSamples / 2) / kSamples);
    }
    return pixels;
  }

 private:
  /// Through a point of the picture, in samples from the middle of the top left one.
  V3f ray_direction(float column, float row) const { return top_left_ + right_ * column - up_ * row; }

  /// The 16 samples of each pixel of a tile.
  std::array<Ray, RayScene::kPacket> rays_of(int x, int y) const {
    std::array<Ray, RayScene::kPacket> rays;
    for (int i = 0; i < int(rays.size()); ++i) {
      int const pixel = i / kSamples, sample = i % kSamples;
      float const column = float((x + pixel % kTile) * kSupersample + sample % kSupersample);
      float const row = float((y + pixel / kTile) * kSupersample + sample / kSupersample);
      rays[i] = {eye_, ray_direction(column, row), float(camera_.near), float(camera_.far)};
    }
    return rays;
  }

  /// All samples of a pixel are seen along the line through its middle.
  Shading shading_at(int x, int y) const {
    float const middle = (kSupersample - 1) / 2.0f;
    V3f const sight = ray_direction(float(kSupersample * x) + middle, float(kSupersample * y) + middle);
    return {-sight.normalized(), to_light_};
  }

  /// What the ray shows from its first hit on: front to back, on white, in the client's encoded values.
  Texel sample(Ray ray, Hit hit, Shading const& shading) const {
    std::array<float, 3> shown{};
    float clear = 1;
    for (int layer = 0; layer < kMostLayers; ++layer) {
      Layer const at = look(ray, hit, shading);
      if (at.coverage >= 1 && clear == 1) return {at.bytes[0], at.bytes[1], at.bytes[2], 255};
      for (std::size_t k = 0; k < 3; ++k) shown[k] += clear * at.coverage * float(at.bytes[k]);
      clear *= 1 - at.coverage;
      if (clear <= 0) break;
      ray.near = std::nextafter(hit.distance, ray.far);
      std::optional<Hit> const behind = model_.scene.first_hit(ray);
      if (!behind) break;
      hit = *behind;
    }
    auto const byte = [](float value) { return static_cast<std::uint8_t>(std::lround(std::min(value, 255.0f))); };
    float const white = 255 * clear;
    return {byte(shown[0] + white), byte(shown[1] + white), byte(shown[2] + white), byte(255 - white)};
  }

  struct Layer {
    std::array<std::uint8_t, 3> bytes;
    float coverage;
  };

  Layer look(Ray const& ray, Hit const& hit, Shading const& shading) const {
    SourceModel const& source = *model_.model;
    Triangle const& face = source.mesh.triangles[hit.face];
    V3f const a = source.mesh.positions[face[0]];
    V3f const normal = (source.mesh.positions[face[1]] - a).cross(source.mesh.positions[face[2]] - a);
    float const slope = ray.direction.dot(normal);
    SurfaceSample const surface = model_.surface.sample(hit, footprint(ray, hit, normal, slope));
    V3f const base = options_.grey ? V3f(kGrey) : V3f(surface.colour[0], surface.colour[1], surface.colour[2]);
    std::size_t const material = source.face_materials.empty() ? 0 : source.face_materials[hit.face];
    V3f const light =
        source.materials[material].unlit ? base : shading(base, slope > 0 ? -surface.normal : surface.normal);
    return {srgb_bytes(light), surface.colour[3]};
  }

  /// How far the hit moves on its face from this sample to the next one to the right, and to the one above.
  std::array<V3f, 2> footprint(Ray const& ray, Hit const& hit, V3f const& normal, float slope) const {
    auto const moved = [&](V3f const& step) {
      return (step - ray.direction * (step.dot(normal) / slope)) * hit.distance;
    };
    return {moved(right_), moved(up_)};
  }

  SurveyedModel const& model_;
  PictureOptions options_;
  Camera camera_;
  V3f eye_, top_left_, right_, up_;  ///< in the model's own coordinates; per sample, at depth 1
  V3f to_light_;
};

/// What of a tile lies within the picture.
void put(std::array<Texel, kTilePixels> const& tile, Image& picture, int left, int top) {
  for (int p = 0; p < kTilePixels; ++p) {
    int const x = left + p % kTile, y = top + p / kTile;
    if (x < picture.width && y < picture.height)
      std::copy(tile[p].begin(), tile[p].end(), &picture.texels[4 * (std::size_t(y) * picture.width + x)]);
  }
}

}  // namespace

std::vector<Image> render(SurveyedModel const& model, std::vector<Camera> const& cameras,
                          PictureOptions const& options) {
  std::size_t const size = static_cast<std::size_t>(options.size);
  std::vector<Image> pictures(cameras.size());
  for (Image& picture : pictures)
    picture = {options.size, options.size, 4, ColourSpace::srgb, std::vector<std::uint8_t>(4 * size * size)};
  std::size_t const rows = (size + kTile - 1) / kTile;
  parallel_for(cameras.size() * rows, 8, [&](std::size_t i) {
    Painter const painter(model, cameras[i / rows], options);
    for (int x = 0, y = int(i % rows) * kTile; x < options.size; x += kTile)
      put(painter.tile(x, y), pictures[i / rows], x, y);
  });
  return pictures;
}

}  // namespace vitrine
