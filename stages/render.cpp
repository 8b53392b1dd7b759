// SPDX-License-Identifier: Apache-2.0
#include "stages/render.h"

#include "stages/closest_point.h"
#include "stages/depth_buffer.h"
#include "stages/parallel.h"
#include "stages/shade.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace vitrine {
namespace {

constexpr int kMostLayers = 64;  ///< transparent ones that a ray passes before it sees the background
constexpr float kGrey = 0.5f;
constexpr std::size_t kMostFaces = std::size_t{1} << 20;  ///< beyond, a ray finds its face sooner than all are drawn

/// One sample as the client's frame buffer holds it.
using Texel = std::array<std::uint8_t, 4>;
constexpr Texel kNothing{255, 255, 255, 0};

/// Draws one view of one model.
class Painter {
 public:
  Painter(SurveyedModel const& model, Camera const& camera, PictureOptions const& options)
      : model_(model), options_(options), lens_(camera, model.model->origin, options.size * options.supersample) {
    V3d const to_light = options.light == Light::head ? -camera.forward : camera.up - camera.right - camera.forward;
    to_light_ = V3f(to_light.normalized());
  }

  Image picture(DepthBuffer& buffer) const {
    Image picture{options_.size, options_.size, 4, ColourSpace::srgb, {}};
    for (int i = 0; i < options_.size * options_.size; ++i)
      picture.texels.insert(picture.texels.end(), kNothing.begin(), kNothing.end());
    if (first_face_is_all() && buffer.draw(model_.model->mesh, lens_))
      draw_faces(buffer, picture);
    else
      trace(picture);
    return picture;
  }

 private:
  bool first_face_is_all() const {
    return model_.surface.alpha() == AlphaMode::opaque && model_.model->mesh.triangles.size() <= kMostFaces;
  }

  void draw_faces(DepthBuffer const& buffer, Image& picture) const {
    if (buffer.right() < buffer.left() || buffer.bottom() < buffer.top()) return;
    int const n = options_.supersample, top = buffer.top() / n, left = buffer.left() / n;
    parallel_for(std::size_t(buffer.bottom() / n - top + 1), 16, [&](std::size_t row) {
      for (int x = left, y = top + int(row); x <= buffer.right() / n; ++x)
        put(picture, x, y, [&](int column, int line, Shading const& shading) {
          std::uint32_t const face = buffer.face(column, line);
          if (face == DepthBuffer::kNothing) return kNothing;
          V3f const direction = lens_.direction(float(column), float(line));
          Layer const seen = look(direction, on_face(face, direction), shading);
          return Texel{seen.bytes[0], seen.bytes[1], seen.bytes[2], 255};
        });
    });
  }

  /// Packets of rays, each for a square of pixels.
  void trace(Image& picture) const {
    int const side = int(std::sqrt(double(RayScene::kPacket))), n = options_.supersample, tile = side / n;
    std::size_t const rows = std::size_t((options_.size + tile - 1) / tile);
    parallel_for(rows, 8, [&](std::size_t row) {
      for (int left = 0, top = int(row) * tile; left < options_.size; left += tile) {
        std::array<Ray, RayScene::kPacket> rays;
        for (int i = 0; i < int(rays.size()); ++i)
          rays[i] = {lens_.eye, lens_.direction(float(left * n + i % side), float(top * n + i / side)), lens_.near, lens_.far};
        auto const hits = model_.scene.first_hits(rays);
        for (int y = top; y < std::min(top + tile, options_.size); ++y)
          for (int x = left; x < std::min(left + tile, options_.size); ++x)
            put(picture, x, y, [&](int column, int line, Shading const& shading) {
              std::size_t const i = std::size_t((line - top * n) * side + column - left * n);
              return hits[i] ? layers(rays[i], *hits[i], shading) : kNothing;
            });
      }
    });
  }

  /// The mean of a pixel's samples, all seen along the line through its middle.
  template <class SampleAt>
  void put(Image& picture, int x, int y, SampleAt const& sample_at) const {
    int const n = options_.supersample, samples = n * n;
    float const middle = float(n - 1) / 2;
    Shading const shading(-lens_.direction(float(n * x) + middle, float(n * y) + middle).normalized(), to_light_);
    std::array<int, 4> sums{};
    for (int i = 0; i < samples; ++i) {
      Texel const texel = sample_at(n * x + i % n, n * y + i / n, shading);
      for (std::size_t k = 0; k < 4; ++k) sums[k] += texel[k];
    }
    std::uint8_t* const pixel = &picture.texels[4 * (std::size_t(y) * std::size_t(options_.size) + std::size_t(x))];
    for (std::size_t k = 0; k < 4; ++k) pixel[k] = static_cast<std::uint8_t>((sums[k] + samples / 2) / samples);
  }

  /// Where the ray meets the face, or where it passes by within the rounding of the depth buffer.
  Hit on_face(std::uint32_t face, V3f const& direction) const {
    TriMesh const& mesh = model_.model->mesh;
    Triangle const& t = mesh.triangles[face];
    V3f const a = mesh.positions[t[0]], b = mesh.positions[t[1]] - a, c = mesh.positions[t[2]] - a;
    V3f const normal = b.cross(c), from_a = lens_.eye - a;
    float const slope = direction.dot(normal), distance = slope != 0 ? -from_a.dot(normal) / slope : 0;
    V3f const p = from_a + direction * distance;
    float const area = normal.length2(), u = p.cross(c).dot(normal) / area, v = b.cross(p).dot(normal) / area;
    if (u >= 0 && v >= 0 && u + v <= 1) return {face, u, v, distance};
    Barycentric const near = closest_on_triangle(p, b, c);
    return {face, near.u, near.v, distance};
  }

  /// What the ray shows from its first hit on: front to back, on white, in the client's encoded values.
  Texel layers(Ray ray, Hit hit, Shading const& shading) const {
    std::array<float, 3> shown{};
    float clear = 1;
    for (int layer = 0; layer < kMostLayers; ++layer) {
      Layer const at = look(ray.direction, hit, shading);
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

  Layer look(V3f const& direction, Hit const& hit, Shading const& shading) const {
    SourceModel const& source = *model_.model;
    Triangle const& face = source.mesh.triangles[hit.face];
    V3f const a = source.mesh.positions[face[0]];
    V3f const normal = (source.mesh.positions[face[1]] - a).cross(source.mesh.positions[face[2]] - a);
    float const slope = direction.dot(normal);
    SurfaceSample const surface = model_.surface.sample(hit, footprint(direction, hit, normal, slope));
    V3f const base = options_.grey ? V3f(kGrey) : V3f(surface.colour[0], surface.colour[1], surface.colour[2]);
    std::size_t const material = source.face_materials.empty() ? 0 : source.face_materials[hit.face];
    V3f const light =
        source.materials[material].unlit ? base : shading(base, slope > 0 ? -surface.normal : surface.normal);
    return {srgb_bytes(light), surface.colour[3]};
  }

  /// How far the hit moves on its face from this sample to the next one to the right, and to the one above.
  std::array<V3f, 2> footprint(V3f const& direction, Hit const& hit, V3f const& normal, float slope) const {
    auto const moved = [&](V3f const& step) {
      return (step - direction * (step.dot(normal) / slope)) * hit.distance;
    };
    return {moved(lens_.right), moved(lens_.up)};
  }

  SurveyedModel const& model_;
  PictureOptions options_;
  Lens lens_;
  V3f to_light_;
};

}  // namespace

std::vector<Image> render(SurveyedModel const& model, std::vector<Camera> const& cameras,
                          PictureOptions const& options) {
  std::vector<Image> pictures(cameras.size());
  constexpr std::size_t views_per_buffer = 2;  // what the system asks for fresh memory is a tenth of a view
  parallel_blocks(cameras.size(), views_per_buffer, [&](std::size_t begin, std::size_t end) {
    DepthBuffer buffer(options.size * options.supersample);
    for (std::size_t i = begin; i < end; ++i) pictures[i] = Painter(model, cameras[i], options).picture(buffer);
  });
  return pictures;
}

}  // namespace vitrine
