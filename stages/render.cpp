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
constexpr std::size_t kPackets = kSamples / RayScene::kPacket;
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

  Texel pixel(int x, int y) const {
    std::array<int, 4> sums{};
    Shading const shading(-ray_direction(kSupersample * float(x) + 1.5f, kSupersample * float(y) + 1.5f).normalized(),
                          to_light_);
    for (std::size_t packet = 0; packet < kPackets; ++packet) {
      std::array<Ray, RayScene::kPacket> const rays = rays_of(x, y, packet);
      auto const hits = model_.scene.first_hits(rays);
      for (std::size_t i = 0; i < rays.size(); ++i) {
        Texel const texel = hits[i] ? sample(rays[i], *hits[i], shading) : Texel{255, 255, 255, 0};
        for (std::size_t k = 0; k < 4; ++k) sums[k] += texel[k];
      }
    }
    Texel mean;
    for (std::size_t k = 0; k < 4; ++k) mean[k] = static_cast<std::uint8_t>((sums[k] + kSamples / 2) / kSamples);
    return mean;
  }

 private:
  /// Through a point of the picture, in samples from the middle of the top left one.
  V3f ray_direction(float column, float row) const { return top_left_ + right_ * column - up_ * row; }

  /// Half of the pixel's samples, row by row.
  std::array<Ray, RayScene::kPacket> rays_of(int x, int y, std::size_t packet) const {
    std::array<Ray, RayScene::kPacket> rays;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      int const sample = int(packet * rays.size() + i);
      float const column = float(x * kSupersample + sample % kSupersample);
      float const row = float(y * kSupersample + sample / kSupersample);
      rays[i] = {eye_, ray_direction(column, row), float(camera_.near), float(camera_.far)};
    }
    return rays;
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
    return {{srgb_byte(light.x), srgb_byte(light.y), srgb_byte(light.z)}, surface.colour[3]};
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

}  // namespace

std::vector<Image> render(SurveyedModel const& model, std::vector<Camera> const& cameras,
                          PictureOptions const& options) {
  std::size_t const size = static_cast<std::size_t>(options.size);
  std::vector<Image> pictures(cameras.size());
  for (Image& picture : pictures)
    picture = {options.size, options.size, 4, ColourSpace::srgb, std::vector<std::uint8_t>(4 * size * size)};
  parallel_blocks(cameras.size() * size, 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Painter const painter(model, cameras[i / size], options);
      Texel* const row = reinterpret_cast<Texel*>(&pictures[i / size].texels[4 * size * (i % size)]);
      for (std::size_t x = 0; x < size; ++x) row[x] = painter.pixel(int(x), int(i % size));
    }
  });
  return pictures;
}

}  // namespace vitrine
